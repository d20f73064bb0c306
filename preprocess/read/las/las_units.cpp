#include "preprocess/read/las/las_units.h"

#include "engine/base/crs.h"
#include "engine/base/length_unit.h"
#include "preprocess/base/little_endian.h"

namespace splatray {
namespace {

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
  if (crs.horizontal_metres == 0.0 && !crs.is_degrees)
    crs.horizontal_metres = epsg_system_metres(found.projected);
  if (crs.vertical_metres == 0.0) crs.vertical_metres = epsg_system_metres(found.vertical);
  return found;
}

/// A sentence where the key of the unit and the unit of EPSG's system differ, by more than the two feet do.
std::optional<std::string> contradiction(const KeyedCrs& keyed) {
  const double by_key = keyed.crs.horizontal_metres, by_system = epsg_system_metres(keyed.projected);
  if (by_system == 0.0 || is_same_unit(by_key, by_system)) return std::nullopt;
  return "x and y are in " + length_name(by_key) + " by the file's key of units and in " +
         length_name(by_system) + " by EPSG:" + std::to_string(keyed.projected) + "; the key is taken";
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
  if (vlrs.wkt.empty())
    if (auto sentence = contradiction(crs_of_keys(vlrs.geo_keys))) return sentence;
  const std::string sentence = different_units(units);
  return sentence.empty() ? std::nullopt : std::optional(sentence);
}

std::optional<bool> las_in_degrees(const LasVlrs& vlrs) {
  const Crs units = units_of(vlrs);
  return units.is_degrees || units.is_projected ? std::optional(units.is_degrees) : std::nullopt;
}

}  // namespace splatray
