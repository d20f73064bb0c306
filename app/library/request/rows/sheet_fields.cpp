#include "app/library/request/fields.h"
#include "engine/base/utf8.h"

namespace splatray {
namespace {

constexpr FieldGroup SHEET = FieldGroup::sheet;
constexpr const char* OF_SECTIONS = "the viewer draws the section that it shows, by a dialog";

Field not_in_panels(Field row) {
  row.doors = DOOR_RENDER | DOOR_LIBRARY;
  row.why_not = OF_SECTIONS;
  return row;
}

Field sheet_row() {
  return value_row(
      "sheet", SHEET, "KIND[:VALUE,...]",
      "a drawing to scale: plan[:z=HEIGHT], cut at that height; section:X0,Y0,X1,Y1, along that line, "
      "looking to its "
      "left; elevation:north|east|south|west|DEGREES, from that side; ortho:DX,DY,DZ, in that direction; "
      "atlas[:above=HEIGHT], a page of each floor, cut 1.2 m above it; with "
      "depth=D behind the cut, scale=50 for 1:50, dpi=300, weight=0.35 for the cut's lines in mm, "
      "hatch=1.5 for the hatching of what is cut in mm, contours=INTERVAL of heights in a plan, "
      "level=Z for marks of floors and ceilings that count from that height, "
      "unit=m|cm|mm|ft|us-ft "
      "where the file does not say, of a page paper=A4|A3|A2|A1|A0 and portrait or landscape, by default the "
      "smallest that holds the drawing; further views for the page behind ; each, in the same scale; a pixel "
      "is 25.4 mm / dpi x scale; a region limits it",
      [](Request& request, const std::string& text) { request.view.sheet = read_sheet(text); },
      [](const Request& request) {
        return request.view.sheet ? sheet_text(*request.view.sheet) : std::string();
      });
}

}  // namespace

std::vector<Field> sheet_fields() {
  return {
      not_in_panels(needed(sheet_row(), "a plan, section or elevation to scale")),
      not_in_panels(switch_row("ink", SHEET, MEMBER(view.ink),
                               "of a sheet: lines where depth, direction or object change")),
      not_in_panels(switch_row("xray", SHEET, MEMBER(view.xray),
                               "of a sheet: how much surface lies one behind the other, by the logarithm: "
                               "walls seen along them are dark")),
      not_in_panels(value_row(
          "title", SHEET, "TEXT",
          "of a sheet as .svg or .pdf: the title in its title block; default the input's name",
          [](Request& request, const std::string& text) { request.output.title = to_utf8(text); },
          [](const Request& request) { return request.output.title; })),
      not_in_panels(value_row(
          "title-block", SHEET, "KEY=TEXT;...",
          "of a sheet as .svg or .pdf: what its title block says, by the keys project, number, sheet, "
          "revision, author and date",
          [](Request& request, const std::string& text) {
            request.output.title_block = read_title_block(text);
          },
          [](const Request& request) { return title_block_text(request.output.title_block); })),
      not_in_panels(value_row(
          "measures", SHEET, "FILE.geojson",
          "of a sheet as .svg or .pdf: measures of splatray-measure or splatray-view that are drawn on it",
          [](Request& request, const std::string& text) { request.output.measures = text; },
          [](const Request& request) { return request.output.measures.string(); })),
      not_in_panels(value_row(
          "height-raster", SHEET, "FILE.tif",
          "of a sheet: heights, or of sections and elevations distances behind the cut, world units, as "
          "GeoTIFF of floats",
          [](Request& request, const std::string& text) { request.output.height_raster = text; },
          [](const Request& request) { return request.output.height_raster.string(); }))};
}

}  // namespace splatray
