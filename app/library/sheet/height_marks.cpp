#include "app/library/sheet/height_marks.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "app/library/measure/measure_words.h"
#include "app/library/sheet/page_style.h"
#include "app/library/sheet/sheet_view.h"
#include "app/library/sheet/text_block.h"
#include "engine/base/number_text.h"

namespace splatray {
namespace {

// Millimetres.
constexpr double INDEX_LINE = 0.25, LABEL_PAD = 0.4;
constexpr double MARK_BESIDE = 3.0, MARK_TRIANGLE = 2.4, MARK_END = 1.0;
constexpr std::int64_t INDEX_EVERY = 5;
constexpr double LEVEL_DIGITS_METRES = 0.01;

bool is_index(const Sheet& sheet, const Contour& contour) {
  return std::llround(contour.height / *sheet.asked.contours) % INDEX_EVERY == 0;
}

/// Decimals of heights of levels, which are a centimetre's.
int digits_of_levels(const Sheet& sheet) {
  const double digits = std::ceil(-std::log10(LEVEL_DIGITS_METRES / sheet.unit_metres) - 1e-9);
  return std::max(static_cast<int>(digits), 0);
}

/// Writes a contour's height on the first of its points where that covers nothing, from the middle on.
void add_contour_label(const Sheet& sheet, const Contour& contour, const DrawnPath& path, Drawing& view) {
  const TextBox picture{view.rasters.front().corner, view.rasters.front().corner + view.rasters.front().size};
  const std::size_t count = path.points.size();
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec2& at = path.points[(count / 2 + i) % count];
    DrawnText text{at, LABEL_SIZE_MM, TextAnchor::middle, contour_text(sheet, contour)};
    TextBox box = text_box(text);
    const double down = at.y - 0.5 * (box.low.y + box.high.y);
    text.at.y += down;
    box = {box.low + glm::dvec2(-LABEL_PAD, down), box.high + glm::dvec2(LABEL_PAD, down)};
    const bool is_free = std::none_of(view.texts.begin(), view.texts.end(),
                                      [&](const DrawnText& other) { return box.meets(text_box(other)); });
    if (!is_free || !picture.holds(box)) continue;
    view.boxes.push_back({box.low, box.high - box.low, glm::vec3(1.0F)});
    view.texts.push_back(text);
    return;
  }
}

/// A level's line from where it leaves the picture, bent to where its mark has room, and the mark; where no other text is.
void add_level_mark(const glm::dvec2& from, double mark_y, const std::string& text, Drawing& view) {
  const glm::dvec2 begin(from.x + MARK_BESIDE, mark_y), tip(begin.x + 0.5 * MARK_TRIANGLE, mark_y),
      left(begin.x, mark_y - 0.8 * MARK_TRIANGLE), right(begin.x + MARK_TRIANGLE, left.y),
      text_begin(right.x + MARK_END, mark_y - 0.4 * LABEL_SIZE_MM),
      end(text_begin.x + text_width(text, LABEL_SIZE_MM) + MARK_END, mark_y);
  const DrawnText label{text_begin, LABEL_SIZE_MM, TextAnchor::begin, text};
  const TextBox box = text_box(label);
  const bool is_free = std::none_of(view.texts.begin(), view.texts.end(),
                                    [&](const DrawnText& other) { return box.meets(text_box(other)); });
  if (!is_free || box.low.y < 0.0) return;
  for (const auto& [a, b] : {std::pair(from, begin), {begin, end}, {tip, left}, {left, right}, {right, tip}})
    view.lines.push_back({a, b, FINE_LINE_MM});
  view.texts.push_back(label);
  view.size.x = std::max(view.size.x, end.x + MARK_END);
}

}  // namespace

double contour_width_mm(const Sheet& sheet, const Contour& contour) {
  return is_index(sheet, contour) ? INDEX_LINE : FINE_LINE_MM;
}

std::string contour_text(const Sheet& sheet, const Contour& contour) {
  const std::string interval = number_text(*sheet.asked.contours);
  const std::size_t point = interval.find('.');
  const bool has_power = interval.find('e') != std::string::npos;
  if (has_power) return short_number(contour.height);
  return rounded_text(contour.height,
                      point == std::string::npos ? 0 : static_cast<int>(interval.size() - point - 1));
}

std::string level_text(const Sheet& sheet, double height) {
  const std::string text = rounded_text(height - sheet.asked.level.value_or(0.0), digits_of_levels(sheet));
  return text.starts_with('-') ? text : "+" + text;
}

std::string height_text(const Sheet& sheet, double height) {
  return rounded_text(height, digits_of_levels(sheet)) + " " + length_symbol(sheet.unit_metres);
}

bool is_upright_sheet(const Sheet& sheet) {
  constexpr double UPRIGHT = 0.999;
  return glm::dot(sheet.top, glm::normalize(sheet.up)) > UPRIGHT;
}

void draw_contours(const Sheet& sheet, const PixelWindow& window, Drawing& view) {
  std::map<double, std::size_t> longest;  // contour of each height with the most points, by its path
  std::vector<DrawnPath>& paths = view.rasters.front().paths;
  for (const Contour& contour : sheet.contours) {
    DrawnPath path{{}, contour.curve.closed, contour_width_mm(sheet, contour)};
    for (const glm::dvec2& point : contour.curve.points)
      path.points.push_back(view.rasters.front().corner + in_window(sheet, window, point));
    std::size_t& best = longest.emplace(contour.height, paths.size()).first->second;
    if (best < paths.size() && paths[best].points.size() < path.points.size()) best = paths.size();
    paths.push_back(std::move(path));
  }
  const bool few = longest.size() <= 2 * INDEX_EVERY;
  for (const auto& [height, path] : longest) {
    const Contour contour{height, {}};
    if (few || is_index(sheet, contour)) add_contour_label(sheet, contour, paths[path], view);
  }
}

void draw_levels(const Sheet& sheet, const PixelWindow& window, Drawing& view) {
  if (sheet.levels.empty() || !is_upright_sheet(sheet)) return;
  const DrawnRaster& raster = view.rasters.front();
  const double line = line_height(LABEL_SIZE_MM);
  double free_above = raster.corner.y + raster.size.y;  // marks of lower levels are below it
  for (const double height : sheet.levels) {
    const glm::dvec2 on_paper = sheet.on_paper(height * glm::normalize(sheet.up));
    const double y = in_window(sheet, window, {sheet.corner.x, on_paper.y}).y + raster.corner.y;
    if (y < raster.corner.y || y > raster.corner.y + raster.size.y) continue;
    const double mark_y = std::min(y, free_above);
    free_above = mark_y - line - 0.5 * LABEL_SIZE_MM;
    add_level_mark({raster.corner.x + raster.size.x, y}, mark_y, level_text(sheet, height), view);
  }
}

}  // namespace splatray
