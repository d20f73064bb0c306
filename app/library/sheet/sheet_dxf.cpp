#include "app/library/sheet/sheet_dxf.h"

#include <array>

#include "app/library/codec/dxf.h"
#include "app/library/cut/curve_window.h"
#include "app/library/sheet/height_marks.h"
#include "app/library/sheet/measure_marks.h"
#include "app/library/sheet/page_style.h"
#include "app/library/sheet/sheet_page.h"

namespace splatray {
namespace {

constexpr const char *CUT_LAYER = "CUT", *HATCH_LAYER = "HATCH", *CONTOUR_LAYER = "CONTOURS",
                     *LEVEL_LAYER = "LEVELS", *BEYOND_LAYER = "BEYOND", *HIDDEN_LAYER = "HIDDEN",
                     *MEASURES_LAYER = "MEASURES", *TEXT_LAYER = "TEXT", *FLOOR_PREFIX = "FLOOR";
constexpr int BLACK = 7, RED = 1, GREY = 8, BROWN = 34, LIGHT_GREY = 9;  // AutoCAD's colours
constexpr double LETTERS_MM = 2.5, ROW_MM = 5.0, LEVEL_MARK_MM = 12.0;

/// Behind a view, on paper: room for the marks of its levels and for the border of the next.
constexpr double BETWEEN_MM = 40.0;

/// A sheet in the drawing.
struct Part {
  const Sheet& sheet;
  std::string prefix{};    ///< of its layers
  glm::dvec2 shift{0.0};   ///< of its own coordinates
  std::size_t number = 0;  ///< of its caption; 0 = it has none

  [[nodiscard]] glm::dvec2 at(const glm::dvec2& on_paper) const { return on_paper - sheet.origin + shift; }
  /// Opposite corners of what the sheet shows, along its right and top.
  [[nodiscard]] std::array<glm::dvec2, 2> shown() const {
    const glm::dvec2 size = glm::dvec2(sheet.width, sheet.height) * sheet.pixel_world;
    return {sheet.corner - glm::dvec2(0.0, size.y), sheet.corner + glm::dvec2(size.x, 0.0)};
  }
  [[nodiscard]] std::string layer(const char* name) const { return prefix + name; }
  [[nodiscard]] double letter_height() const { return LETTERS_MM * sheet.mm_world(); }
};

void add_measure(const Part& part, std::size_t id, const Measure& measure, DxfWriter& dxf) {
  const std::string layer = part.layer(MEASURES_LAYER);
  std::vector<glm::dvec2> places;
  glm::dvec2 middle(0.0);
  for (const SurfacePoint& point : measure.points) {
    places.push_back(part.at(part.sheet.on_paper(point.place)));
    middle += places.back() / static_cast<double>(measure.points.size());
    dxf.point(layer, {places.back(), 0.0});
  }
  dxf.polyline(layer, places, is_outline(measure.kind));
  dxf.text(layer, {middle, 0.0}, part.letter_height(),
           std::to_string(id) + ": " + labelled_text(measure, measure_frame(part.sheet)));
}

void add_measures(const Part& part, std::span<const Measure> measures, DxfWriter& dxf) {
  for (std::size_t i = 0; i < measures.size(); ++i)
    if (!measures[i].points.empty()) add_measure(part, i + 1, measures[i], dxf);
}

/// Adds what of a curve the sheet shows: of a section no more than its line is long.
void add_curve(const Part& part, const CutCurve& curve, const char* layer, double height, DxfWriter& dxf) {
  const auto [low, high] = part.shown();
  for (const CutCurve& shown : curve_within(curve, low, high)) {
    std::vector<glm::dvec2> points = shown.points;
    for (glm::dvec2& point : points) point = part.at(point);
    dxf.polyline(part.layer(layer), points, shown.closed, height);
  }
}

void add_hatch(const Part& part, DxfWriter& dxf) {
  const auto [low, high] = part.shown();
  for (const auto& [from, to] : part.sheet.hatch)
    for (const CutCurve& shown : curve_within({{from, to}}, low, high))
      dxf.line(part.layer(HATCH_LAYER), {part.at(shown.points.front()), 0.0},
               {part.at(shown.points.back()), 0.0});
}

/// Contours at their heights, and level marks beside an upright sheet.
void add_heights(const Part& part, DxfWriter& dxf) {
  const Sheet& sheet = part.sheet;
  for (const Contour& contour : sheet.contours)
    add_curve(part, contour.curve, CONTOUR_LAYER, contour.height, dxf);
  if (!is_upright_sheet(sheet)) return;
  const double end = sheet.at(sheet.width, 0.0).x + part.shift.x, mark = LEVEL_MARK_MM * sheet.mm_world();
  for (const double height : sheet.levels) {
    const double y = part.at(sheet.on_paper(height * glm::normalize(sheet.up))).y;
    dxf.line(part.layer(LEVEL_LAYER), {end, y, 0.0}, {end + mark, y, 0.0});
    dxf.text(part.layer(LEVEL_LAYER), {end, y + 0.2 * part.letter_height(), 0.0}, part.letter_height(),
             level_text(sheet, height));
  }
}

void add_drawing(const Part& part, DxfWriter& dxf) {
  const Sheet& sheet = part.sheet;
  for (const CutCurve& curve : sheet.cut_curves) add_curve(part, curve, CUT_LAYER, 0.0, dxf);
  for (const CutCurve& curve : sheet.beyond) add_curve(part, curve, BEYOND_LAYER, 0.0, dxf);
  for (const CutCurve& curve : sheet.overhead) add_curve(part, curve, HIDDEN_LAYER, 0.0, dxf);
  add_hatch(part, dxf);
  add_heights(part, dxf);
}

/// Writes lines of text below a sheet.
void add_texts(const Part& part, const std::vector<std::string>& lines, DxfWriter& dxf) {
  glm::dvec2 at = part.sheet.at(0.0, part.sheet.height) + part.shift;
  for (const std::string& line : lines) {
    at.y -= ROW_MM * part.sheet.mm_world();
    if (!line.empty()) dxf.text(part.layer(TEXT_LAYER), {at, 0.0}, part.letter_height(), line);
  }
}

/// What is written below the first sheet of a page, or a floor.
std::vector<std::string> page_lines(const Sheet& sheet, const std::string& title,
                                    const std::string& subject) {
  std::vector<std::string> lines = {title, scale_text(sheet), subject};
  if (sheet.floor) lines.push_back(floor_text(sheet));
  for (const std::string& note : sheet_notes(sheet)) lines.push_back(note);
  return lines;
}

void add_layers(const Part& part, std::vector<DxfLayer>& layers) {
  for (const DxfLayer& layer :
       {DxfLayer{CUT_LAYER, BLACK}, DxfLayer{HATCH_LAYER, GREY}, DxfLayer{CONTOUR_LAYER, BROWN},
        DxfLayer{LEVEL_LAYER, BLACK}, DxfLayer{BEYOND_LAYER, GREY},
        DxfLayer{HIDDEN_LAYER, LIGHT_GREY, DASH_MM * part.sheet.mm_world()}, DxfLayer{MEASURES_LAYER, RED},
        DxfLayer{TEXT_LAYER, BLACK}})
    layers.push_back({part.layer(layer.name.c_str()), layer.color, layer.dash});
}

DxfWriter writer_for(const std::vector<Part>& parts) {
  std::vector<DxfLayer> layers;
  for (const Part& part : parts)
    if (&part == &parts.front() || !part.prefix.empty()) add_layers(part, layers);
  const Sheet& sheet = parts.front().sheet;
  return {sheet.unit_known ? sheet.unit_metres : 1.0, std::move(layers)};
}

/// Views side by side, their lower borders in one line; the first keeps its coordinates.
std::vector<Part> view_parts(const SheetSet& set) {
  std::vector<Part> parts;
  double right = 0.0, foot = 0.0;
  for (const Sheet& sheet : set.sheets) {
    const glm::dvec2 low = sheet.at(0.0, sheet.height);
    Part part{sheet, {}, glm::dvec2(0.0), parts.size() + 1};
    if (parts.empty())
      foot = low.y;
    else
      part.shift = {right + BETWEEN_MM * sheet.mm_world() - low.x, foot - low.y};
    right = low.x + part.shift.x + sheet.width * sheet.pixel_world;
    parts.push_back(part);
  }
  return parts;
}

std::string views_dxf(const SheetSet& set, const PageWords& words, std::span<const Measure> measures) {
  const std::vector<Part> parts = view_parts(set);
  DxfWriter dxf = writer_for(parts);
  for (const Part& part : parts) {
    const std::string caption = std::to_string(part.number) + "  " + subject_text(part.sheet);
    add_drawing(part, dxf);
    add_measures(part, measures_of_sheet(set, part.number - 1, measures), dxf);
    if (part.number == 1)
      add_texts(part, page_lines(part.sheet, words.title, caption), dxf);
    else
      add_texts(part, {"", "", caption}, dxf);
  }
  return dxf.str();
}

std::string atlas_dxf(const SheetSet& atlas, const PageWords& words, std::span<const Measure> measures) {
  std::vector<Part> parts;
  for (const Sheet& sheet : atlas.sheets)
    parts.push_back({sheet, FLOOR_PREFIX + std::to_string(parts.size() + 1) + "-"});
  DxfWriter dxf = writer_for(parts);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    add_drawing(parts[i], dxf);
    add_measures(parts[i], measures_of_sheet(atlas, i, measures), dxf);
    add_texts(parts[i], page_lines(parts[i].sheet, words.title, subject_text(parts[i].sheet)), dxf);
  }
  return dxf.str();
}

}  // namespace

std::string sheet_dxf(const Sheet& sheet, const PageWords& words, std::span<const Measure> measures) {
  const std::vector<Part> parts = {Part{sheet}};
  DxfWriter dxf = writer_for(parts);
  add_drawing(parts.front(), dxf);
  add_measures(parts.front(), measures, dxf);
  add_texts(parts.front(), page_lines(sheet, words.title, subject_text(sheet)), dxf);
  return dxf.str();
}

std::string sheets_dxf(const SheetSet& set, const PageWords& words, std::span<const Measure> measures) {
  return set.is_atlas ? atlas_dxf(set, words, measures) : views_dxf(set, words, measures);
}

}  // namespace splatray
