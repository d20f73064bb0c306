#include "preprocess/read/las/las_units.h"

#include <charconv>
#include <cmath>
#include <string_view>

#include "preprocess/base/little_endian.h"

namespace splatray {
namespace {

constexpr double FOOT = 0.3048;

/// What a file says; lengths of 0 metres are unknown.
struct Units {
  bool is_degrees = false;
  bool is_projected = false;
  double horizontal_metres = 0.0;
  double vertical_metres = 0.0;
};

/// Metres of a unit by EPSG's code; 0 = another.
double epsg_metres(unsigned code) {
  constexpr unsigned METRE = 9001;
  constexpr unsigned INTERNATIONAL_FOOT = 9002;
  constexpr unsigned US_SURVEY_FOOT = 9003;
  if (code == METRE) return 1.0;
  return code == INTERNATIONAL_FOOT || code == US_SURVEY_FOOT ? FOOT : 0.0;
}

Units units_of_keys(const std::vector<unsigned char>& keys) {
  constexpr std::size_t ENTRY_BYTES = 8;  ///< the head and each key: four 16-bit numbers
  constexpr unsigned MODEL_TYPE = 1024;
  constexpr unsigned PROJECTED = 1;
  constexpr unsigned GEOGRAPHIC = 2;
  constexpr unsigned LINEAR_UNITS = 3076;
  constexpr unsigned VERTICAL_UNITS = 4099;
  Units units;
  for (std::size_t at = ENTRY_BYTES; at + ENTRY_BYTES <= keys.size(); at += ENTRY_BYTES) {
    const unsigned key = load<std::uint16_t>(keys.data() + at);
    const unsigned location = load<std::uint16_t>(keys.data() + at + 2);
    const unsigned value = load<std::uint16_t>(keys.data() + at + 6);
    if (location != 0) continue;  // values that stand elsewhere
    if (key == MODEL_TYPE) units.is_degrees = value == GEOGRAPHIC, units.is_projected = value == PROJECTED;
    if (key == LINEAR_UNITS) units.horizontal_metres = epsg_metres(value);
    if (key == VERTICAL_UNITS) units.vertical_metres = epsg_metres(value);
  }
  return units;
}

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

/// Metres of a block's last unit, which is its own: UNIT["foot",0.3048]; 0 = none.
double last_unit_metres(std::string_view text) {
  const std::size_t unit = text.rfind("UNIT[\"");
  if (unit == std::string_view::npos) return 0.0;
  text = text.substr(unit);
  text = text.substr(std::min(text.find("\",") + 2, text.size()));
  double metres = 0.0;
  std::from_chars(text.data(), text.data() + text.size(), metres);
  return metres;
}

Units units_of_text(std::string_view text) {
  std::string_view projected = block(text, "PROJCS[");
  if (projected.empty()) projected = block(text, "PROJCRS[");
  std::string_view vertical = block(text, "VERT_CS[");
  if (vertical.empty()) vertical = block(text, "VERTCRS[");
  const bool has_angles = text.find("GEOGCS[") != std::string_view::npos ||
                          text.find("GEOGCRS[") != std::string_view::npos ||
                          text.find("GEODCRS[") != std::string_view::npos;
  return {projected.empty() && has_angles, !projected.empty(), last_unit_metres(projected),
          last_unit_metres(vertical)};
}

std::string unit_name(double metres) {
  constexpr double SAME = 1e-4;  // the feet of the United States differ by 2e-6
  if (std::abs(metres - 1.0) < SAME) return "metres";
  if (std::abs(metres - FOOT) < SAME) return "feet";
  return "units of " + std::to_string(metres) + " m";
}

Units units_of(const LasVlrs& vlrs) {
  return vlrs.wkt.empty() ? units_of_keys(vlrs.geo_keys) : units_of_text(vlrs.wkt);
}

}  // namespace

std::optional<std::string> differing_las_units(const LasVlrs& vlrs) {
  const Units units = units_of(vlrs);
  if (units.is_degrees) return "x and y are degrees; the shape is right only in a projected system";
  const std::string horizontal = unit_name(units.horizontal_metres);
  const std::string vertical = unit_name(units.vertical_metres);
  const bool is_known = units.horizontal_metres > 0.0 && units.vertical_metres > 0.0;
  if (!is_known || horizontal == vertical) return std::nullopt;
  return "z is in " + vertical + " while x and y are in " + horizontal;
}

std::optional<bool> las_in_degrees(const LasVlrs& vlrs) {
  const Units units = units_of(vlrs);
  return units.is_degrees || units.is_projected ? std::optional(units.is_degrees) : std::nullopt;
}

}  // namespace splatray
