#include "engine/base/crs.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <initializer_list>

#include "engine/base/length_unit.h"
#include "engine/base/number_text.h"

namespace splatray {
namespace {

constexpr std::string_view EPSG = "EPSG:";

/// The text from a keyword such as "PROJCS[" to the bracket that closes it; empty where it is not there.
std::string_view block(std::string_view text, std::string_view keyword) {
  const std::size_t begin = text.find(keyword);
  if (begin == std::string_view::npos) return {};
  int depth = 0;
  for (std::size_t i = begin; i < text.size(); ++i) {
    depth += text[i] == '[' ? 1 : 0;
    depth -= text[i] == ']' ? 1 : 0;
    if (text[i] == ']' && depth == 0) return text.substr(begin, i - begin);
  }
  return text.substr(begin);
}

template <typename Number>
Number leading_number(std::string_view text) {
  Number number{};
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

/// Metres of a block's last unit, which is its own: UNIT["foot",0.3048]; 0 = none.
double last_unit_metres(std::string_view text) {
  const std::size_t unit = text.rfind("UNIT[\"");
  if (unit == std::string_view::npos) return 0.0;
  text = text.substr(unit);
  return leading_number<double>(text.substr(std::min(text.find("\",") + 2, text.size())));
}

/// EPSG's number of the system that the whole text is, which stands last in it: AUTHORITY["EPSG","25832"]] or ID["EPSG",25832]].
unsigned own_number(std::string_view text) {
  for (const std::string_view keyword : {"AUTHORITY[\"EPSG\",", "ID[\"EPSG\","}) {
    const std::size_t begin = text.rfind(keyword);
    if (begin == std::string_view::npos) continue;
    std::string_view number = text.substr(begin + keyword.size());
    if (std::count(number.begin(), number.end(), ']') != 2) continue;
    number.remove_prefix(std::min(number.find_first_not_of(" \""), number.size()));
    return leading_number<unsigned>(number);
  }
  return 0;
}

/// The block of the first of some keywords that is there.
std::string_view first_block(std::string_view text, std::initializer_list<std::string_view> keywords) {
  for (const std::string_view keyword : keywords)
    if (const std::string_view found = block(text, keyword); !found.empty()) return found;
  return {};
}

Crs describe_wkt(std::string_view text) {
  Crs crs;
  const std::size_t name = text.find("[\"");
  if (name == std::string_view::npos) return crs;
  crs.name = text.substr(name + 2, text.substr(name + 2).find('"'));
  const std::string_view projected = first_block(text, {"PROJCS[", "PROJCRS["});
  const std::string_view vertical = first_block(text, {"VERT_CS[", "VERTCRS["});
  const bool has_angles = text.find("GEOGCS[") != std::string_view::npos ||
                          text.find("GEOGCRS[") != std::string_view::npos ||
                          text.find("GEODCRS[") != std::string_view::npos;
  crs.epsg = own_number(text);
  crs.is_projected = !projected.empty();
  crs.is_degrees = projected.empty() && has_angles;
  crs.horizontal_metres = last_unit_metres(projected);
  crs.vertical_metres = last_unit_metres(vertical);
  return crs;
}

Crs describe_numbers(std::string_view text) {
  Crs crs;
  crs.name = text.substr(0, text.find(';'));
  const std::string_view number = std::string_view(crs.name).substr(EPSG.size());
  crs.epsg = leading_number<unsigned>(number);
  if (const std::size_t plus = number.find('+'); plus != std::string_view::npos)
    crs.vertical_epsg = leading_number<unsigned>(number.substr(plus + 1));
  for (std::size_t at = text.find(';'); at != std::string_view::npos; at = text.find(';', at + 1)) {
    const std::string_view part = text.substr(at + 1);
    if (part.starts_with("deg")) crs.is_degrees = true;
    if (part.starts_with("xy=")) crs.horizontal_metres = leading_number<double>(part.substr(3));
    if (part.starts_with("z=")) crs.vertical_metres = leading_number<double>(part.substr(2));
  }
  crs.is_projected = crs.horizontal_metres > 0.0;
  return crs;
}

}  // namespace

std::string epsg_text(unsigned horizontal, unsigned vertical, const Crs& units) {
  std::string text = std::string(EPSG) + std::to_string(horizontal);
  if (vertical != 0) text += "+" + std::to_string(vertical);
  if (units.is_degrees) text += ";deg";
  if (units.horizontal_metres > 0.0) text += ";xy=" + number_text(units.horizontal_metres);
  if (units.vertical_metres > 0.0) text += ";z=" + number_text(units.vertical_metres);
  return text;
}

Crs describe_crs(std::string_view text) {
  return text.starts_with(EPSG) ? describe_numbers(text) : describe_wkt(text);
}

std::string horizontal_crs(const std::string& text) {
  Crs crs = describe_crs(text);
  if (text.starts_with(EPSG)) {
    crs.vertical_metres = 0.0;
    return epsg_text(crs.epsg, 0, crs);
  }
  if (first_block(text, {"VERT_CS[", "VERTCRS["}).empty()) return text;
  const std::string_view own = first_block(text, {"PROJCS[", "PROJCRS[", "GEOGCS[", "GEOGCRS[", "GEODCRS["});
  return own.empty() ? "" : std::string(own) + "]";
}

std::string different_units(const Crs& crs) {
  constexpr double SAME = 1e-5;
  if (!(crs.horizontal_metres > 0.0 && crs.vertical_metres > 0.0)) return "";
  if (std::abs(crs.vertical_metres / crs.horizontal_metres - 1.0) < SAME) return "";
  return "z is in " + length_name(crs.vertical_metres) + " while x and y are in " +
         length_name(crs.horizontal_metres);
}

bool is_same_crs(std::string_view a, std::string_view b) {
  if (a == b) return true;
  const Crs first = describe_crs(a), second = describe_crs(b);
  if (first.epsg != 0 && second.epsg != 0)
    return first.epsg == second.epsg && first.vertical_epsg == second.vertical_epsg;
  return !first.name.empty() && first.name == second.name;
}

double epsg_unit_metres(unsigned code) {
  for (const LengthUnit& unit : LENGTH_UNITS)
    if (unit.epsg != 0 && unit.epsg == code) return unit.metres;
  return 0.0;
}

std::uint16_t epsg_unit(double metres) {
  const LengthUnit* unit = find_length_unit(metres);
  return unit != nullptr ? unit->epsg : std::uint16_t{0};
}

}  // namespace splatray
