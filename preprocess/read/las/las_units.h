/// Coordinate systems of LAS files.
#pragma once
#include <optional>
#include <string>

#include "preprocess/read/las/las_vlrs.h"

namespace splatray {

/// Scene::crs of a file: its text or, without one, epsg_text of what GeoTIFF's keys name.
[[nodiscard]] std::string las_crs(const LasVlrs& vlrs);

/// A sentence where the file's coordinate system has degrees, two units for x and y, or other units for z than for these; else nothing.
/// Reads of GeoTIFF's keys (OGC GeoTIFF Standard 1.1, annex B) and of well-known text (OGC 12-063r5) only what says so.
[[nodiscard]] std::optional<std::string> differing_las_units(const LasVlrs& vlrs);

/// Whether x and y are degrees, else lengths; nothing where the file's coordinate system does not say.
[[nodiscard]] std::optional<bool> las_in_degrees(const LasVlrs& vlrs);

}  // namespace splatray
