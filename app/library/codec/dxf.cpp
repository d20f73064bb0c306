#include "app/library/codec/dxf.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>

#include "engine/base/number_text.h"

namespace splatray {
namespace {

// Handles of what every file has; those of layers and entities follow.
enum Handle : unsigned {
  VPORTS = 1,
  LTYPES,
  LAYERS,
  STYLES,
  VIEWS,
  UCSS,
  APPIDS,
  DIMSTYLES,
  BLOCK_RECORDS,  // tables
  BY_BLOCK,
  BY_LAYER,
  CONTINUOUS,
  STANDARD_STYLE,
  ACAD,
  STANDARD_DIMSTYLE,
  MODEL_SPACE,
  PAPER_SPACE,
  MODEL_BLOCK,
  MODEL_END,
  PAPER_BLOCK,
  PAPER_END,
  ROOT_DICTIONARY,
  GROUPS,
  VIEWPORT,
  DASHED,
  FIRST_LAYER = 0x100
};

struct Pair {
  int code;
  std::string value;
};

std::string hex(unsigned handle) {
  std::array<char, 16> text{};
  (void)std::snprintf(text.data(), text.size(), "%X", handle);
  return text.data();
}

void add(std::ostream& out, const std::vector<Pair>& pairs) {
  for (const Pair& pair : pairs) out << pair.code << "\n" << pair.value << "\n";
}

/// $INSUNITS of the length; 0 = no unit.
int unit_number(double metres) {
  struct Unit {
    double metres;
    int number;
  };
  constexpr std::array UNITS = {Unit{1.0, 6}, Unit{0.01, 5}, Unit{0.001, 4}, Unit{0.3048, 2},
                                Unit{1200.0 / 3937.0, 21}};
  for (const Unit& unit : UNITS)
    if (std::abs(metres - unit.metres) < 1e-7 * unit.metres) return unit.number;
  return 0;
}

/// The code point that begins there, and moves behind it; UTF-8.
std::uint32_t next_letter(const std::string& text, std::size_t& at) {
  const auto byte = static_cast<unsigned char>(text[at++]);
  std::uint32_t letter =
      byte < 0x80U ? byte : (byte < 0xE0U ? byte & 0x1FU : (byte < 0xF0U ? byte & 0x0FU : byte & 0x07U));
  for (; at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0U) == 0x80U; ++at)
    letter = letter << 6U | (static_cast<unsigned char>(text[at]) & 0x3FU);
  return letter;
}

std::string escaped(const std::string& text) {
  constexpr std::uint32_t MOST = 0xFFFF;
  std::string letters;
  for (std::size_t at = 0; at < text.size();) {
    const std::uint32_t letter = next_letter(text, at);
    std::array<char, 16> code{};
    (void)std::snprintf(code.data(), code.size(), "\\U+%04X", letter);
    if (letter < 0x80U)
      letters += letter < ' ' || letter == 0x7FU ? ' ' : static_cast<char>(letter);
    else
      letters += letter > MOST ? "?" : code.data();
  }
  return letters;
}

void add_table(std::ostream& out, const char* name, Handle handle, std::size_t records) {
  add(out, {{0, "TABLE"},
            {2, name},
            {5, hex(handle)},
            {330, "0"},
            {100, "AcDbSymbolTable"},
            {70, std::to_string(records)}});
}

/// A record of a table, up to its name and flags.
void add_record(std::ostream& out, const char* type, unsigned handle, Handle table, const char* subclass,
                const std::string& name, bool has_flags = true) {
  const int handle_code = std::string_view(type) == "DIMSTYLE" ? 105 : 5;
  add(out, {{0, type},
            {handle_code, hex(handle)},
            {330, hex(table)},
            {100, "AcDbSymbolTableRecord"},
            {100, subclass},
            {2, name}});
  if (has_flags) add(out, {{70, "0"}});
}

void end_table(std::ostream& out) { add(out, {{0, "ENDTAB"}}); }

/// `dash`: the length of a dash.
void add_line_types(std::ostream& out, double dash) {
  add_table(out, "LTYPE", LTYPES, 4);
  for (const auto& [name, handle] :
       {std::pair("ByBlock", BY_BLOCK), {"ByLayer", BY_LAYER}, {"Continuous", CONTINUOUS}}) {
    add_record(out, "LTYPE", handle, LTYPES, "AcDbLinetypeTableRecord", name);
    add(out, {{3, ""}, {72, "65"}, {73, "0"}, {40, "0"}});
  }
  add_record(out, "LTYPE", DASHED, LTYPES, "AcDbLinetypeTableRecord", "DASHED");
  add(out, {{3, "__ __ __"},
            {72, "65"},
            {73, "2"},
            {40, number_text(1.5 * dash)},
            {49, number_text(dash)},
            {74, "0"},
            {49, number_text(-0.5 * dash)},
            {74, "0"}});
  end_table(out);
}

void add_layers(std::ostream& out, const std::vector<DxfLayer>& layers) {
  add_table(out, "LAYER", LAYERS, layers.size());
  for (std::size_t i = 0; i < layers.size(); ++i) {
    add_record(out, "LAYER", FIRST_LAYER + static_cast<unsigned>(i), LAYERS, "AcDbLayerTableRecord",
               layers[i].name);
    add(out, {{62, std::to_string(layers[i].color)}, {6, layers[i].dash > 0.0 ? "DASHED" : "Continuous"}});
  }
  end_table(out);
}

/// A window on all of the drawing.
void add_viewport(std::ostream& out, const glm::dvec3& low, const glm::dvec3& high) {
  const glm::dvec3 middle = 0.5 * (low + high);
  const double height = std::max(1.1 * (high.y - low.y), 1e-6),
               width = std::max(1.1 * (high.x - low.x), 1e-6);
  add_table(out, "VPORT", VPORTS, 1);
  add_record(out, "VPORT", VIEWPORT, VPORTS, "AcDbViewportTableRecord", "*Active");
  add(out, {{10, "0"},
            {20, "0"},
            {11, "1"},
            {21, "1"},
            {12, number_text(middle.x)},
            {22, number_text(middle.y)},
            {16, "0"},
            {26, "0"},
            {36, "1"},
            {17, "0"},
            {27, "0"},
            {37, "0"},
            {40, number_text(std::max(height, 0.5 * width))},
            {41, "2"},
            {42, "50"}});
  end_table(out);
}

void add_tables(std::ostream& out, const std::vector<DxfLayer>& layers, const glm::dvec3& low,
                const glm::dvec3& high) {
  add(out, {{0, "SECTION"}, {2, "TABLES"}});
  add_viewport(out, low, high);
  double dash = 1.0;
  for (const DxfLayer& layer : layers)
    if (layer.dash > 0.0) dash = layer.dash;
  add_line_types(out, dash);
  add_layers(out, layers);
  add_table(out, "STYLE", STYLES, 1);
  add_record(out, "STYLE", STANDARD_STYLE, STYLES, "AcDbTextStyleTableRecord", "Standard");
  add(out, {{40, "0"}, {41, "1"}, {50, "0"}, {71, "0"}, {42, "1"}, {3, "txt"}, {4, ""}});
  end_table(out);
  for (const auto& [name, handle] : {std::pair("VIEW", VIEWS), {"UCS", UCSS}}) {
    add_table(out, name, handle, 0);
    end_table(out);
  }
  add_table(out, "APPID", APPIDS, 1);
  add_record(out, "APPID", ACAD, APPIDS, "AcDbRegAppTableRecord", "ACAD");
  end_table(out);
  add_table(out, "DIMSTYLE", DIMSTYLES, 1);
  add(out, {{100, "AcDbDimStyleTable"}});
  add_record(out, "DIMSTYLE", STANDARD_DIMSTYLE, DIMSTYLES, "AcDbDimStyleTableRecord", "Standard");
  end_table(out);
  add_table(out, "BLOCK_RECORD", BLOCK_RECORDS, 2);
  for (const auto& [name, handle] : {std::pair("*Model_Space", MODEL_SPACE), {"*Paper_Space", PAPER_SPACE}})
    add_record(out, "BLOCK_RECORD", handle, BLOCK_RECORDS, "AcDbBlockTableRecord", name, false);
  end_table(out);
  add(out, {{0, "ENDSEC"}});
}

void add_block(std::ostream& out, const std::string& name, Handle record, Handle begin, Handle end) {
  add(out, {{0, "BLOCK"},
            {5, hex(begin)},
            {330, hex(record)},
            {100, "AcDbEntity"},
            {8, "0"},
            {100, "AcDbBlockBegin"},
            {2, name},
            {70, "0"},
            {10, "0"},
            {20, "0"},
            {30, "0"},
            {3, name},
            {1, ""},
            {0, "ENDBLK"},
            {5, hex(end)},
            {330, hex(record)},
            {100, "AcDbEntity"},
            {8, "0"},
            {100, "AcDbBlockEnd"}});
}

void add_objects(std::ostream& out) {
  add(out, {{0, "SECTION"},
            {2, "OBJECTS"},
            {0, "DICTIONARY"},
            {5, hex(ROOT_DICTIONARY)},
            {330, "0"},
            {100, "AcDbDictionary"},
            {281, "1"},
            {3, "ACAD_GROUP"},
            {350, hex(GROUPS)},
            {0, "DICTIONARY"},
            {5, hex(GROUPS)},
            {330, hex(ROOT_DICTIONARY)},
            {100, "AcDbDictionary"},
            {281, "1"},
            {0, "ENDSEC"},
            {0, "EOF"}});
}

}  // namespace

glm::dvec3 in_object_system(const glm::dvec3& place, const glm::dvec3& axis) {
  constexpr double NEAR = 1.0 / 64.0;
  const bool is_upright = std::abs(axis.x) < NEAR && std::abs(axis.y) < NEAR;
  const glm::dvec3 other = is_upright ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(0.0, 0.0, 1.0);
  const glm::dvec3 x = glm::normalize(glm::cross(other, axis)), y = glm::cross(axis, x);
  return {glm::dot(place, x), glm::dot(place, y), glm::dot(place, axis)};
}

DxfWriter::DxfWriter(double unit_metres, std::vector<DxfLayer> layers)
    : unit_metres_(unit_metres), layers_(std::move(layers)) {
  layers_.insert(layers_.begin(), {"0", 7});
  handle_ = FIRST_LAYER + static_cast<unsigned>(layers_.size());
}

void DxfWriter::include(const glm::dvec3& at) {
  low_ = low_ ? glm::min(*low_, at) : at;
  high_ = high_ ? glm::max(*high_, at) : at;
}

void DxfWriter::entity(const char* type, const std::string& layer, const char* subclass) {
  add(entities_, {{0, type},
                  {5, hex(handle_++)},
                  {330, hex(MODEL_SPACE)},
                  {100, "AcDbEntity"},
                  {8, layer},
                  {100, subclass}});
}

void DxfWriter::place(int code, const glm::dvec3& at) {
  for (int axis = 0; axis < 3; ++axis) add(entities_, {{code + 10 * axis, number_text(at[axis])}});
}

void DxfWriter::polyline(const std::string& layer, const std::vector<glm::dvec2>& points, bool closed,
                         double height) {
  if (points.size() < 2) return;
  entity("LWPOLYLINE", layer, "AcDbPolyline");
  add(entities_, {{90, std::to_string(points.size())}, {70, closed ? "1" : "0"}});
  if (height != 0.0) add(entities_, {{38, number_text(height)}});
  for (const glm::dvec2& point : points) {
    add(entities_, {{10, number_text(point.x)}, {20, number_text(point.y)}});
    include({point, height});
  }
}

void DxfWriter::line(const std::string& layer, const glm::dvec3& from, const glm::dvec3& to) {
  entity("LINE", layer, "AcDbLine");
  place(10, from);
  place(11, to);
  include(from);
  include(to);
}

void DxfWriter::point(const std::string& layer, const glm::dvec3& at) {
  entity("POINT", layer, "AcDbPoint");
  place(10, at);
  include(at);
}

void DxfWriter::circle(const std::string& layer, const glm::dvec3& center, double radius,
                       const glm::dvec3& axis) {
  const double length = glm::length(axis);
  const glm::dvec3 normal = length > 0.0 ? axis / length : glm::dvec3(0.0, 0.0, 1.0);
  entity("CIRCLE", layer, "AcDbCircle");
  place(10, in_object_system(center, normal));
  add(entities_, {{40, number_text(radius)}});
  place(210, normal);
  include(center - radius);
  include(center + radius);
}

void DxfWriter::text(const std::string& layer, const glm::dvec3& at, double height,
                     const std::string& letters) {
  entity("TEXT", layer, "AcDbText");
  place(10, at);
  add(entities_, {{40, number_text(height)}, {1, escaped(letters)}, {100, "AcDbText"}});
  include(at);
}

std::string DxfWriter::str() const {
  const glm::dvec3 low = low_.value_or(glm::dvec3(0.0)), high = high_.value_or(glm::dvec3(0.0));
  std::ostringstream out;
  add(out, {{0, "SECTION"},
            {2, "HEADER"},
            {9, "$ACADVER"},
            {1, "AC1015"},
            {9, "$DWGCODEPAGE"},
            {3, "ANSI_1252"},
            {9, "$INSUNITS"},
            {70, std::to_string(unit_number(unit_metres_))},
            {9, "$HANDSEED"},
            {5, hex(handle_)}});
  for (const auto& [name, at] : {std::pair("$EXTMIN", low), {"$EXTMAX", high}})
    add(out, {{9, name}, {10, number_text(at.x)}, {20, number_text(at.y)}, {30, number_text(at.z)}});
  add(out, {{0, "ENDSEC"}});
  add_tables(out, layers_, low, high);
  add(out, {{0, "SECTION"}, {2, "BLOCKS"}});
  add_block(out, "*Model_Space", MODEL_SPACE, MODEL_BLOCK, MODEL_END);
  add_block(out, "*Paper_Space", PAPER_SPACE, PAPER_BLOCK, PAPER_END);
  add(out, {{0, "ENDSEC"}, {0, "SECTION"}, {2, "ENTITIES"}});
  out << entities_.str();
  add(out, {{0, "ENDSEC"}});
  add_objects(out);
  return out.str();
}

}  // namespace splatray
