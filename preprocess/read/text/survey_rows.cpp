#include "preprocess/read/text/survey_rows.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/release.h"
#include "preprocess/read/scan/stored_colors.h"

namespace splatray {
namespace {

constexpr glm::u16vec3 WHITE_16_BIT{65535};

/// Appends a value of point `at`; the points before that have none get `absent`.
template <typename Value>
void append_at(std::vector<Value>& list, std::size_t at, const Value& absent, const Value& value) {
  if (list.size() < at) list.resize(at, absent);
  list.push_back(value);
}

template <typename Value>
void fill_up(std::vector<Value>& list, std::size_t size, const Value& absent) {
  if (!list.empty()) list.resize(size, absent);
}

}  // namespace

void SurveyRows::append(const double* row, std::size_t width, const glm::dvec3& position_world,
                        const glm::dvec3& normal_world) {
  const std::size_t at = points_.size();
  points_.position.push_back(position_world);
  if (width > 3) append_at(intensity_, at, 0.0F, std::isfinite(row[3]) ? static_cast<float>(row[3]) : 0.0F);
  if (width > 4)
    append_at(points_.stored_color, at, WHITE_16_BIT,
              glm::u16vec3(stored_channel(row[4]), stored_channel(row[5]), stored_channel(row[6])));
  if (width > 7) append_at(points_.normal, at, glm::vec3(0.0F), glm::vec3(normal_world));
}

Points SurveyRows::take() {
  std::uint16_t most = 0;
  for (const glm::u16vec3& color : points_.stored_color)
    if (color != WHITE_16_BIT) most = std::max({most, color.x, color.y, color.z});
  points_.stored_color_most = most > 255 ? 65535 : 255;
  if (most == 0) release(points_.stored_color);
  fill_up(points_.stored_color, points_.size(), WHITE_16_BIT);
  fill_up(points_.normal, points_.size(), glm::vec3(0.0F));
  fill_up(intensity_, points_.size(), 0.0F);
  if (!intensity_.empty()) points_.columns.push_back({std::string(COLUMN_INTENSITY), std::move(intensity_)});
  return std::move(points_);
}

}  // namespace splatray
