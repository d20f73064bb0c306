#include "app/library/sheet/geotiff.h"

#include "engine/base/crs.h"

namespace splatray {
namespace {

constexpr std::uint16_t MODEL_TYPE = 1024, RASTER_TYPE = 1025, CITATION = 1026, GEOGRAPHIC = 2048,
                        PROJECTED = 3072, LINEAR_UNITS = 3076;
constexpr std::uint16_t ASCII_PARAMS = 34737, USER_DEFINED = 32767;

/// Adds keys to a directory, in the order of their numbers.
class KeyDirectory {
 public:
  explicit KeyDirectory(GeoTags& tags) : tags_(tags) { tags_.keys = {1, 1, 1, 0}; }

  void add(std::uint16_t key, std::uint16_t value) { add(key, 0, 1, value); }
  void add(std::uint16_t key, const std::string& text) {
    const std::size_t at = tags_.ascii.size();
    tags_.ascii += text + "|";
    add(key, ASCII_PARAMS, static_cast<std::uint16_t>(text.size() + 1), static_cast<std::uint16_t>(at));
  }

 private:
  void add(std::uint16_t key, std::uint16_t location, std::uint16_t count, std::uint16_t value) {
    tags_.keys.insert(tags_.keys.end(), {key, location, count, value});
    ++tags_.keys[3];
  }
  GeoTags& tags_;
};

}  // namespace

GeoTags geo_tags(const GeoPlace& place) {
  GeoTags tags;
  tags.pixel_scale = {place.pixel, place.pixel, 0.0};
  tags.tiepoint = {0.0, 0.0, 0.0, place.corner.x, place.corner.y, 0.0};
  const Crs crs = describe_crs(place.crs);
  const bool known = crs.epsg > 0 && crs.epsg < USER_DEFINED, degrees = crs.is_degrees;
  KeyDirectory keys(tags);
  constexpr std::uint16_t AREA = 1;
  keys.add(MODEL_TYPE, place.crs.empty() ? USER_DEFINED : (degrees ? 2 : 1));
  keys.add(RASTER_TYPE, AREA);
  if (!crs.name.empty()) keys.add(CITATION, crs.name);
  const auto code = static_cast<std::uint16_t>(known ? crs.epsg : USER_DEFINED);
  if (!place.crs.empty()) keys.add(degrees ? GEOGRAPHIC : PROJECTED, code);
  const std::uint16_t unit = epsg_unit(crs.horizontal_metres);
  if (!place.crs.empty() && !degrees && unit > 0) keys.add(LINEAR_UNITS, unit);
  return tags;
}

}  // namespace splatray
