#include "preprocess/read/text/survey_rows.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/release.h"
#include "preprocess/read/scan/stored_colors.h"
#include "preprocess/read/text/unnamed_columns.h"

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

void SurveyRows::judge(const RowRun& run) {
  if (is_judged_ || run.width < 6) return;
  is_judged_ = true;
  constexpr std::size_t MOST = 1000;
  const std::size_t count = std::min(run.rows, MOST);
  const std::size_t first = run.width % 3 == 1 ? 4 : 3;
  std::vector<float> columns[3];
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t c = 0; c < 3; ++c) columns[c].push_back(static_cast<float>(run.row(i)[first + c]));
  normals_first_ = are_normals({&columns[0], &columns[1], &columns[2]}, 0);
}

std::optional<std::size_t> SurveyRows::normal_cell(std::size_t width) const {
  const std::size_t first = width % 3 == 1 ? 4 : 3;
  if (width >= first + 3 && normals_first_) return first;
  return width >= first + 6 ? std::optional(first + 3) : std::nullopt;
}

void SurveyRows::append(const double* row, std::size_t width, const glm::dvec3& position_world,
                        const glm::dvec3& normal_world) {
  const std::size_t at = points_.size();
  points_.position.push_back(position_world);
  const bool has_intensity = width % 3 == 1;
  if (has_intensity)
    append_at(intensity_, at, 0.0F, std::isfinite(row[3]) ? static_cast<float>(row[3]) : 0.0F);
  const std::size_t first = has_intensity ? 4 : 3;
  const std::size_t color = first + (normals_first_ ? 3 : 0);
  if (width >= color + 3)
    for (std::size_t c = 0; c < 3; ++c) append_at(channel_[c], at, NAN, static_cast<float>(row[color + c]));
  if (normal_cell(width)) append_at(points_.normal, at, glm::vec3(0.0F), glm::vec3(normal_world));
}

/// By all of the file's colours; white, which stands for "none" beside others, is not counted.
void SurveyRows::store_all_colors(std::vector<std::string>& notes) {
  if (channel_[0].empty()) return;
  for (std::vector<float>& channel : channel_) channel.resize(points_.size(), NAN);
  const std::vector<float>& red = channel_[0];
  std::vector<std::uint32_t> absent;
  for (std::size_t i = 0; i < red.size(); ++i)
    if (std::isnan(red[i])) absent.push_back(static_cast<std::uint32_t>(i));
  if (const std::string said = store_colors(std::move(channel_), points_); !said.empty())
    notes.push_back(said);
  ColorRange range;
  range.add(points_.stored_color);
  if (range.is_black()) return release(points_.stored_color);
  if (points_.stored_color_most == 0) {
    points_.stored_color_most = static_cast<std::uint16_t>(range.full());
    if (const std::string said = color_note(range); !said.empty()) notes.push_back(said);
  }
  for (const std::uint32_t i : absent) points_.stored_color[i] = WHITE_16_BIT;
}

Points SurveyRows::take(std::vector<std::string>& notes) {
  store_all_colors(notes);
  fill_up(points_.normal, points_.size(), glm::vec3(0.0F));
  fill_up(intensity_, points_.size(), 0.0F);
  if (!intensity_.empty()) points_.columns.push_back({std::string(COLUMN_INTENSITY), std::move(intensity_)});
  return std::move(points_);
}

}  // namespace splatray
