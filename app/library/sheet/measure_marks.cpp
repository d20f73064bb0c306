#include "app/library/sheet/measure_marks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>

#include "app/library/sheet/page_style.h"
#include "app/library/sheet/sheet_view.h"
#include "app/library/sheet/text_block.h"

namespace splatray {
namespace {

// Millimetres.
constexpr double MARK = 0.8, MARK_LINE = 0.25;
constexpr double NEAREST = 1.2, FARTHEST = 12.0, NEXT = 1.2;  ///< of a value from the middle of its measure
constexpr int DIRECTIONS = 8;

/// The text where it covers no other and stays on the picture, the nearest such place first; nothing where there is none.
std::optional<DrawnText> placed(const std::string& text, const glm::dvec2& middle, const Drawing& view) {
  const TextBox picture{view.rasters.front().corner, view.rasters.front().corner + view.rasters.front().size};
  std::vector<TextBox> taken;
  for (const DrawnText& other : view.texts) taken.push_back(text_box(other));
  for (double away = NEAREST; away <= FARTHEST; away += NEXT)
    for (int i = 0; i < DIRECTIONS; ++i) {
      const double turn = (0.5 + i) * 2.0 * std::numbers::pi / DIRECTIONS;  // up and to the right first
      const glm::dvec2 to(std::cos(turn), -std::sin(turn));
      const DrawnText there{middle + away * to, TEXT_SIZE_MM,
                            to.x > 0.0 ? TextAnchor::begin : TextAnchor::end, text};
      const TextBox box = text_box(there);
      const bool is_free =
          std::none_of(taken.begin(), taken.end(), [&](const TextBox& other) { return box.meets(other); });
      if (is_free && picture.holds(box)) return there;
    }
  return {};
}

/// Draws points and lines, and returns the middle.
glm::dvec2 draw_marks(MeasureKind kind, const std::vector<glm::dvec2>& places, Drawing& view) {
  glm::dvec2 middle(0.0);
  for (const glm::dvec2& at : places) {
    middle += at / static_cast<double>(places.size());
    view.boxes.push_back({at - glm::dvec2(0.5 * MARK), glm::dvec2(MARK)});
  }
  for (std::size_t i = 1; i < places.size(); ++i) view.lines.push_back({places[i - 1], places[i], MARK_LINE});
  if (is_outline(kind)) view.lines.push_back({places.back(), places.front(), MARK_LINE});
  return middle;
}

}  // namespace

MeasureFrame measure_frame(const Sheet& sheet) { return {sheet.up, sheet.crs, sheet.unit_metres}; }

ShownMeasures draw_measures(const Sheet& sheet, const PixelWindow& window, std::span<const Measure> measures,
                            Drawing& view) {
  const glm::dvec2 size = view.rasters.front().size;
  const auto is_on = [&size](const glm::dvec2& at) {
    return at.x >= 0.0 && at.y >= 0.0 && at.x <= size.x && at.y <= size.y;
  };
  const MeasureFrame frame = measure_frame(sheet);
  ShownMeasures shown;
  std::string without_room;
  const std::vector<MeasureRow> rows = measure_rows(measures, frame);
  for (std::size_t i = 0; i < measures.size(); ++i) {
    std::vector<glm::dvec2> places;
    for (const SurfacePoint& point : measures[i].points)
      places.push_back(in_window(sheet, window, sheet.on_paper(point.place)));
    if (places.empty() || !std::all_of(places.begin(), places.end(), is_on)) continue;
    std::copy_if(rows.begin(), rows.end(), std::back_inserter(shown.rows),
                 [i](const MeasureRow& row) { return row.id == i + 1; });
    for (glm::dvec2& at : places) at += view.rasters.front().corner;
    const glm::dvec2 middle = draw_marks(measures[i].kind, places, view);
    const std::string number = std::to_string(i + 1);
    std::optional<DrawnText> text = placed(number + ": " + short_text(measures[i], frame), middle, view);
    if (!text) text = placed(number, middle, view);
    if (text)
      view.texts.push_back(*text);
    else
      without_room += (without_room.empty() ? "" : ", ") + number;
  }
  if (!without_room.empty())
    shown.notes.push_back("No room at their places for the numbers of " + without_room);
  return shown;
}

}  // namespace splatray
