#include "app/library/sheet/sheet_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "app/library/measure/measure_words.h"
#include "app/library/sheet/height_marks.h"
#include "app/library/sheet/page_style.h"
#include "app/library/sheet/seen_lines.h"
#include "app/library/sheet/text_block.h"
#include "engine/base/number_text.h"

namespace splatray {
namespace {

// Millimetres.
constexpr double TICK = 2.0, GRID_LEAST = 30.0, CROSS = 1.5, LABEL_BESIDE = 0.6;
constexpr double BEHIND = 3.0;  ///< room to the right and below

/// Where a line of the grid lies on the paper, from the window's corner, and its coordinate.
struct GridLine {
  double at_mm;
  std::string label;
};

/// Round coordinates from `first` on, which lie within `length` of paper.
std::vector<GridLine> grid_lines(double first, double way, double length_mm, double mm_per_world,
                                 double step) {
  const int digits = std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 6);
  std::vector<GridLine> lines;
  const double begin = way > 0.0 ? std::ceil(first / step) : std::floor(first / step);
  for (double i = 0.0;; ++i) {
    const double value = (begin + way * i) * step, at = way * (value - first) * mm_per_world;
    if (at > length_mm) return lines;
    lines.push_back({at, rounded_text(value, digits)});
  }
}

void add_frame(Drawing& view) {
  const glm::dvec2 corner = view.rasters.front().corner, end = corner + view.rasters.front().size;
  const std::array<glm::dvec2, 4> corners = {corner, {end.x, corner.y}, end, {corner.x, end.y}};
  for (std::size_t i = 0; i < corners.size(); ++i)
    view.lines.push_back({corners[i], corners[(i + 1) % corners.size()], CELL_LINE_MM});
}

/// A coordinate above the picture or, turned, to its left, unless it would reach beyond the given room along its line.
void add_label(const GridLine& line, bool upwards, const std::array<double, 2>& room, Drawing& view) {
  const double half = 0.5 * text_width(line.label, LABEL_SIZE_MM);
  const double at = line.at_mm + (upwards ? view.rasters.front().corner.y : view.rasters.front().corner.x);
  if (at - half < room[0] || at + half > room[1]) return;
  const double across =
      (upwards ? view.rasters.front().corner.x : view.rasters.front().corner.y) - TICK - LABEL_BESIDE;
  view.texts.push_back({upwards ? glm::dvec2(across, at) : glm::dvec2(at, across), LABEL_SIZE_MM,
                        TextAnchor::middle, line.label, upwards});
}

void add_ticks(const std::vector<GridLine>& across, const std::vector<GridLine>& along, Drawing& view) {
  const glm::dvec2 corner = view.rasters.front().corner, end = corner + view.rasters.front().size;
  for (const GridLine& line : across) {
    const double x = corner.x + line.at_mm;
    view.lines.push_back({{x, corner.y - TICK}, {x, corner.y}, FINE_LINE_MM});
    view.lines.push_back({{x, end.y}, {x, end.y + TICK}, FINE_LINE_MM});
    add_label(line, false, {0.0, view.size.x}, view);
  }
  for (const GridLine& line : along) {
    const double y = corner.y + line.at_mm;
    view.lines.push_back({{corner.x - TICK, y}, {corner.x, y}, FINE_LINE_MM});
    view.lines.push_back({{end.x, y}, {end.x + TICK, y}, FINE_LINE_MM});
    add_label(line, true, {corner.y, end.y}, view);
  }
}

/// Crosses where the lines of the grid meet, on the picture alone.
void add_crosses(const std::vector<GridLine>& across, const std::vector<GridLine>& along, Drawing& view) {
  const glm::dvec2 arm(CROSS, 0.0), other(0.0, CROSS);
  for (const GridLine& x : across)
    for (const GridLine& y : along) {
      const glm::dvec2 at(x.at_mm, y.at_mm), beyond = view.rasters.front().size - at;
      if (std::min({at.x, at.y, beyond.x, beyond.y}) < CROSS) continue;
      const glm::dvec2 place = view.rasters.front().corner + at;
      view.lines.push_back({place - arm, place + arm, FINE_LINE_MM});
      view.lines.push_back({place - other, place + other, FINE_LINE_MM});
    }
}

/// The step of the grid: round, and so wide that its labels do not meet.
double grid_step(const Sheet& sheet, const std::array<double, 4>& ends) {
  double step = round_length(GRID_LEAST * sheet.mm_world(), Rounding::up);
  const auto widest = [&] {
    const int digits = std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 6);
    double width = 0.0;
    for (const double end : ends)
      width = std::max(width, text_width(rounded_text(end, digits), LABEL_SIZE_MM));
    return width;
  };
  while (widest() + 2.0 * LABEL_SIZE_MM > step / sheet.mm_world())
    step = round_length(1.5 * step, Rounding::up);
  return step;
}

void add_grid(const Sheet& sheet, const PixelWindow& window, Drawing& view) {
  const glm::dvec2 first = sheet.at(window.x, window.y);
  const glm::dvec2 last = sheet.at(window.x + window.width, window.y + window.height);
  const double step = grid_step(sheet, {first.x, first.y, last.x, last.y}),
               per_world = 1.0 / sheet.mm_world();
  const auto across = grid_lines(first.x, 1.0, view.rasters.front().size.x, per_world, step);
  const auto along = grid_lines(first.y, -1.0, view.rasters.front().size.y, per_world, step);
  add_ticks(across, along, view);
  add_crosses(across, along, view);
}

void add_curve(const Sheet& sheet, const PixelWindow& window, const CutCurve& curve, double width_mm,
               Drawing& view) {
  DrawnPath path{{}, curve.closed, width_mm};
  for (const glm::dvec2& point : curve.points)
    path.points.push_back(view.rasters.front().corner + in_window(sheet, window, point));
  view.rasters.front().paths.push_back(std::move(path));
}

void add_seen(const Sheet& sheet, const PixelWindow& window, Drawing& view) {
  for (const CutCurve& curve : sheet.beyond) add_curve(sheet, window, curve, SEEN_LINE_MM, view);
  for (const CutCurve& curve : sheet.overhead)
    for (const CutCurve& dash : dashed(curve, sheet.mm_world()))
      add_curve(sheet, window, dash, SEEN_LINE_MM, view);
}

void add_cut(const Sheet& sheet, const PixelWindow& window, Drawing& view) {
  for (const CutCurve& curve : sheet.cut_curves) add_curve(sheet, window, curve, sheet.asked.weight_mm, view);
  for (const auto& [from, to] : sheet.hatch)
    view.rasters.front().paths.push_back({{view.rasters.front().corner + in_window(sheet, window, from),
                                           view.rasters.front().corner + in_window(sheet, window, to)},
                                          false,
                                          FINE_LINE_MM});
}

}  // namespace

double round_length(double length, Rounding way) {
  const double power = std::pow(10.0, std::floor(std::log10(length)));
  if (way == Rounding::up) {
    for (const double step : {1.0, 2.0, 5.0})
      if (step * power >= length) return step * power;
    return 10.0 * power;
  }
  double best = power;
  for (const double step : {2.0, 5.0})
    if (step * power <= length) best = step * power;
  return best;
}

std::string length_text(const Sheet& sheet, double world) {
  return number_text(std::round(world * 1e6) / 1e6) + " " + length_symbol(sheet.unit_metres);
}

glm::dvec2 in_window(const Sheet& sheet, const PixelWindow& window, const glm::dvec2& place) {
  return (sheet.pixel_of(place) - glm::dvec2(window.x, window.y)) * sheet.pixel_mm();
}

Drawing sheet_view(const Sheet& sheet, const PixelWindow& window) {
  Drawing view;
  const double before = TICK + LABEL_BESIDE + line_height(LABEL_SIZE_MM);
  view.rasters.emplace_back();
  view.rasters.front().corner = glm::dvec2(before);
  view.rasters.front().size = glm::dvec2(window.width, window.height) * sheet.pixel_mm();
  view.size = view.rasters.front().corner + view.rasters.front().size + glm::dvec2(BEHIND);
  add_seen(sheet, window, view);
  add_cut(sheet, window, view);
  add_frame(view);
  add_grid(sheet, window, view);
  draw_contours(sheet, window, view);
  draw_levels(sheet, window, view);
  return view;
}

}  // namespace splatray
