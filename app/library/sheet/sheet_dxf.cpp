#include "app/library/sheet/sheet_dxf.h"

#include "app/library/codec/dxf.h"
#include "app/library/sheet/height_marks.h"
#include "app/library/sheet/measure_marks.h"
#include "app/library/sheet/page_style.h"

namespace splatray {
namespace {

constexpr const char *CUT_LAYER = "CUT", *HATCH_LAYER = "HATCH", *CONTOUR_LAYER = "CONTOURS",
                     *LEVEL_LAYER = "LEVELS", *BEYOND_LAYER = "BEYOND", *HIDDEN_LAYER = "HIDDEN",
                     *MEASURES_LAYER = "MEASURES", *TEXT_LAYER = "TEXT";
constexpr int BLACK = 7, RED = 1, GREY = 8, BROWN = 34, LIGHT_GREY = 9;  // AutoCAD's colours
constexpr double LETTERS_MM = 2.5, ROW_MM = 5.0, LEVEL_MARK_MM = 12.0;

void add_measure(const Sheet& sheet, std::size_t id, const Measure& measure, double letter_height,
                 DxfWriter& dxf) {
  std::vector<glm::dvec2> places;
  glm::dvec2 middle(0.0);
  for (const SurfacePoint& point : measure.points) {
    places.push_back(sheet.on_paper(point.place) - sheet.origin);
    middle += places.back() / static_cast<double>(measure.points.size());
    dxf.point(MEASURES_LAYER, {places.back(), 0.0});
  }
  dxf.polyline(MEASURES_LAYER, places, measure.kind == MeasureKind::area);
  dxf.text(MEASURES_LAYER, {middle, 0.0}, letter_height,
           std::to_string(id) + ": " + labelled_text(measure, measure_frame(sheet)));
}

void add_curves(const Sheet& sheet, const std::vector<CutCurve>& curves, const char* layer, DxfWriter& dxf) {
  for (const CutCurve& curve : curves) {
    std::vector<glm::dvec2> points = curve.points;
    for (glm::dvec2& point : points) point -= sheet.origin;
    dxf.polyline(layer, points, curve.closed);
  }
}

/// Contours at their heights, and level marks beside an upright sheet.
void add_heights(const Sheet& sheet, double letter_height, DxfWriter& dxf) {
  for (const Contour& contour : sheet.contours) {
    std::vector<glm::dvec2> points = contour.curve.points;
    for (glm::dvec2& point : points) point -= sheet.origin;
    dxf.polyline(CONTOUR_LAYER, points, contour.curve.closed, contour.height);
  }
  if (!is_upright_sheet(sheet)) return;
  const double end = sheet.at(sheet.width, 0.0).x, mark = LEVEL_MARK_MM * sheet.mm_world();
  for (const double height : sheet.levels) {
    const double y = sheet.on_paper(height * glm::normalize(sheet.up)).y - sheet.origin.y;
    dxf.line(LEVEL_LAYER, {end, y, 0.0}, {end + mark, y, 0.0});
    dxf.text(LEVEL_LAYER, {end, y + 0.2 * letter_height, 0.0}, letter_height, level_text(sheet, height));
  }
}

}  // namespace

std::string sheet_dxf(const Sheet& sheet, const PageWords& words, std::span<const Measure> measures) {
  DxfWriter dxf(sheet.unit_known ? sheet.unit_metres : 1.0,
                {{CUT_LAYER, BLACK},
                 {HATCH_LAYER, GREY},
                 {CONTOUR_LAYER, BROWN},
                 {LEVEL_LAYER, BLACK},
                 {BEYOND_LAYER, GREY},
                 {HIDDEN_LAYER, LIGHT_GREY, DASH_MM * sheet.mm_world()},
                 {MEASURES_LAYER, RED},
                 {TEXT_LAYER, BLACK}});
  add_curves(sheet, sheet.cut_curves, CUT_LAYER, dxf);
  add_curves(sheet, sheet.beyond, BEYOND_LAYER, dxf);
  add_curves(sheet, sheet.overhead, HIDDEN_LAYER, dxf);
  for (const auto& [from, to] : sheet.hatch)
    dxf.line(HATCH_LAYER, {from - sheet.origin, 0.0}, {to - sheet.origin, 0.0});
  const double letter_height = LETTERS_MM * sheet.mm_world();
  add_heights(sheet, letter_height, dxf);
  for (std::size_t i = 0; i < measures.size(); ++i)
    add_measure(sheet, i + 1, measures[i], letter_height, dxf);
  glm::dvec2 at = sheet.at(0.0, sheet.height);
  std::vector<std::string> lines = {words.title, scale_text(sheet)};
  for (const std::string& note : sheet_notes(sheet)) lines.push_back(note);
  for (const std::string& line : lines) {
    at.y -= ROW_MM * sheet.mm_world();
    if (!line.empty()) dxf.text(TEXT_LAYER, {at, 0.0}, letter_height, line);
  }
  return dxf.str();
}

}  // namespace splatray
