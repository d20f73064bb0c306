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

void SurveyRows::judge(const RowRun& run, bool intensity_first) {
  if (is_judged_ || run.width < 6) return;
  is_judged_ = true;
  constexpr std::size_t MOST = 1000;
  std::vector<std::vector<float>> values(run.width - 3);
  std::vector<const std::vector<float>*> columns;
  for (std::size_t c = 0; c < values.size(); ++c) {
    for (std::size_t i = 0; i < std::min(run.rows, MOST); ++i)
      values[c].push_back(static_cast<float>(run.row(i)[3 + c]));
    columns.push_back(&values[c]);
  }
  if (run.width % 3 == 1 && !intensity_first) intensity_cell_ = 3 + find_intensity(columns).column;
  normals_first_ = are_normals(columns, triple_cell(run.width, 0) - 3);
}

std::size_t SurveyRows::triple_cell(std::size_t width, std::size_t triple) const {
  const std::size_t cell = 3 + 3 * triple;
  return width % 3 == 1 && intensity_cell_ <= cell ? cell + 1 : cell;
}

std::optional<std::size_t> SurveyRows::normal_cell(std::size_t width) const {
  const std::size_t cell = triple_cell(width, normals_first_ ? 0 : 1);
  return width >= cell + 3 ? std::optional(cell) : std::nullopt;
}

void SurveyRows::append(const double* row, std::size_t width, const glm::dvec3& position_world,
                        const glm::dvec3& normal_world) {
  const std::size_t at = points_.size();
  points_.position.push_back(position_world);
  const double intensity = row[std::min(intensity_cell_, width - 1)];
  if (width % 3 == 1)
    append_at(intensity_, at, 0.0F, std::isfinite(intensity) ? static_cast<float>(intensity) : 0.0F);
  const std::size_t color = triple_cell(width, normals_first_ ? 1 : 0);
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
  if (intensity_cell_ != 3)
    notes.push_back("by its values column " + std::to_string(intensity_cell_ + 1) +
                    " is taken as the intensity, and not column 4; --columns names them otherwise");
  store_all_colors(notes);
  fill_up(points_.normal, points_.size(), glm::vec3(0.0F));
  fill_up(intensity_, points_.size(), 0.0F);
  if (!intensity_.empty()) points_.columns.push_back({std::string(COLUMN_INTENSITY), std::move(intensity_)});
  return std::move(points_);
}

}  // namespace splatray
