/// A raster and what its file says of its place: TIFF 6.0 with the tags of GeoTIFF (OGC 19-008r4).
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "shaders/layout.h"

namespace splatray {

/// A raster, top row first: bytes of four channels (sRGB that alpha is not multiplied into, and alpha), or floats of one.
struct GeoRaster {
  std::uint32_t width = 0, height = 0;
  std::vector<std::uint8_t> rgba;
  std::vector<float> floats;  ///< NaN = nothing there
};

/// The values of the tags that a TIFF has as a GeoTIFF.
struct GeoTags {
  std::vector<double> pixel_scale;   ///< 33550 ModelPixelScale
  std::vector<double> tiepoint;      ///< 33922 ModelTiepoint
  std::vector<std::uint16_t> keys;   ///< 34735 GeoKeyDirectory
  std::string ascii;                 ///< 34737 GeoAsciiParams
  std::string description, no_data;  ///< 270 ImageDescription, 42113 GDAL_NODATA
  double dots_per_inch = 0.0;        ///< of the paper; 0 = unknown
};

}  // namespace splatray
