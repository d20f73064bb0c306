/// Pictures that say where they lie: TIFF 6.0 with the tags of GeoTIFF (OGC 19-008r4).
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "app/library/codec/geo_raster.h"

namespace splatray {

/// Where a raster lies; its pixels are squares.
struct GeoPlace {
  glm::dvec2 corner{0.0};  ///< outer corner of the top left pixel, x to the right, y to the top
  double pixel = 1.0;      ///< side of a pixel, > 0
  std::string crs{};       ///< Scene::crs; empty = a local system
};

/// The tags of a place. A system that has no number of EPSG's is named.
[[nodiscard]] GeoTags geo_tags(const GeoPlace& place);

}  // namespace splatray
