#include "preprocess/read/las/las_units.h"

#include <cmath>

#include "engine/base/crs.h"
#include "preprocess/base/little_endian.h"

namespace splatray {
namespace {

constexpr double FOOT = 0.3048;

/// EPSG's number that a key has, 0 where it has none of EPSG's.
unsigned epsg_number(unsigned value) {
  constexpr unsigned LEAST = 1024, MOST = 32766;
  return value >= LEAST && value <= MOST ? value : 0;
}

/// What GeoTIFF's keys say.
struct KeyedCrs {
  Crs crs;  ///< without a name
  unsigned geographic = 0, projected = 0, vertical = 0;
};

KeyedCrs crs_of_keys(const std::vector<unsigned char>& keys) {
  constexpr std::size_t ENTRY_BYTES = 8;  ///< the head and each key: four 16-bit numbers
  constexpr unsigned MODEL_TYPE = 1024;
  constexpr unsigned PROJECTED = 1;
  constexpr unsigned GEOGRAPHIC = 2;
  constexpr unsigned GEOGRAPHIC_SYSTEM = 2048;
  constexpr unsigned PROJECTED_SYSTEM = 3072;
  constexpr unsigned LINEAR_UNITS = 3076;
  constexpr unsigned VERTICAL_SYSTEM = 4096;
  constexpr unsigned VERTICAL_UNITS = 4099;
  KeyedCrs found;
  Crs& crs = found.crs;
  for (std::size_t at = ENTRY_BYTES; at + ENTRY_BYTES <= keys.size(); at += ENTRY_BYTES) {
    const unsigned key = load<std::uint16_t>(keys.data() + at);
    const unsigned location = load<std::uint16_t>(keys.data() + at + 2);
    const unsigned value = load<std::uint16_t>(keys.data() + at + 6);
    if (location != 0) continue;  // values that stand elsewhere
    if (key == MODEL_TYPE) crs.is_degrees = value == GEOGRAPHIC, crs.is_projected = value == PROJECTED;
    if (key == GEOGRAPHIC_SYSTEM) found.geographic = epsg_number(value);
    if (key == PROJECTED_SYSTEM) found.projected = epsg_number(value);
    if (key == VERTICAL_SYSTEM) found.vertical = epsg_number(value);
    if (key == LINEAR_UNITS) crs.horizontal_metres = epsg_unit_metres(value);
    if (key == VERTICAL_UNITS) crs.vertical_metres = epsg_unit_metres(value);
  }
  return found;
}

std::string unit_name(double metres) {
  constexpr double SAME = 1e-4;  // the feet of the United States differ by 2e-6
  if (std::abs(metres - 1.0) < SAME) return "metres";
  if (std::abs(metres - FOOT) < SAME) return "feet";
  return "units of " + std::to_string(metres) + " m";
}

Crs units_of(const LasVlrs& vlrs) {
  return vlrs.wkt.empty() ? crs_of_keys(vlrs.geo_keys).crs : describe_crs(vlrs.wkt);
}

}  // namespace

std::string las_crs(const LasVlrs& vlrs) {
  if (!vlrs.wkt.empty()) return vlrs.wkt;
  const KeyedCrs keyed = crs_of_keys(vlrs.geo_keys);
  const unsigned number = keyed.crs.is_degrees ? keyed.geographic : keyed.projected;
  return number == 0 ? "" : epsg_text(number, keyed.vertical, keyed.crs);
}

std::optional<std::string> differing_las_units(const LasVlrs& vlrs) {
  const Crs units = units_of(vlrs);
  if (units.is_degrees) return "x and y are degrees; the shape is right only in a projected system";
  const std::string horizontal = unit_name(units.horizontal_metres);
  const std::string vertical = unit_name(units.vertical_metres);
  const bool is_known = units.horizontal_metres > 0.0 && units.vertical_metres > 0.0;
  if (!is_known || horizontal == vertical) return std::nullopt;
  return "z is in " + vertical + " while x and y are in " + horizontal;
}

std::optional<bool> las_in_degrees(const LasVlrs& vlrs) {
  const Crs units = units_of(vlrs);
  return units.is_degrees || units.is_projected ? std::optional(units.is_degrees) : std::nullopt;
}

}  // namespace splatray
