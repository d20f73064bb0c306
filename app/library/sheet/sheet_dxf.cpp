#include "app/library/sheet/sheet_dxf.h"

#include "app/library/codec/dxf.h"

namespace splatray {
namespace {

constexpr const char *CUT_LAYER = "CUT", *BEYOND_LAYER = "BEYOND", *HIDDEN_LAYER = "HIDDEN",
                     *MEASURES_LAYER = "MEASURES", *TEXT_LAYER = "TEXT";
constexpr int BLACK = 7, RED = 1, GREY = 8, LIGHT_GREY = 9;  // AutoCAD's colours
constexpr double LETTERS_MM = 2.5, ROW_MM = 5.0;

void add_measure(const Sheet& sheet, const Measure& measure, double letter_height, DxfWriter& dxf) {
  std::vector<glm::dvec2> places;
  glm::dvec2 middle(0.0);
  for (const SurfacePoint& point : measure.points) {
    places.push_back(sheet.on_paper(point.place) - sheet.origin);
    middle += places.back() / static_cast<double>(measure.points.size());
    dxf.point(MEASURES_LAYER, {places.back(), 0.0});
  }
  dxf.polyline(MEASURES_LAYER, places, measure.kind == MeasureKind::area);
  dxf.text(MEASURES_LAYER, {middle, 0.0}, letter_height, short_text(measure, sheet.up));
}

}  // namespace

std::string sheet_dxf(const Sheet& sheet, const PageWords& words, std::span<const Measure> measures) {
  DxfWriter dxf(sheet.unit_known ? sheet.unit_metres : 1.0, {{CUT_LAYER, BLACK},
                                                             {BEYOND_LAYER, GREY},
                                                             {HIDDEN_LAYER, LIGHT_GREY},
                                                             {MEASURES_LAYER, RED},
                                                             {TEXT_LAYER, BLACK}});
  for (const CutCurve& curve : sheet.cut_curves) {
    std::vector<glm::dvec2> points = curve.points;
    for (glm::dvec2& point : points) point -= sheet.origin;
    dxf.polyline(CUT_LAYER, points, curve.closed);
  }
  const double letter_height = LETTERS_MM * sheet.mm_world();
  for (const Measure& measure : measures) add_measure(sheet, measure, letter_height, dxf);
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
