/// Measures in files of others: GeoJSON (RFC 7946, but in the file's own coordinates), DXF, tables.
#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "app/library/measure/measure_words.h"

namespace splatray {

[[nodiscard]] std::string geojson_text(std::span<const Measure> measures, const MeasureFrame& frame);
/// Lines, points and circles with their values as text, on the layer MEASURES.
[[nodiscard]] std::string dxf_text(std::span<const Measure> measures, const MeasureFrame& frame);

/// Throws Error (usage) for a name that ends in none of .geojson, .dxf and .csv.
void require_measures_name(const std::filesystem::path& path);
/// Writes them in the format of the name. Throws Error: as require_measures_name, and failed.
void write_measures(std::span<const Measure> measures, const MeasureFrame& frame,
                    const std::filesystem::path& path);
/// Reads what geojson_text wrote, or other programs of it or themselves, the values anew from the points. Properties of others are passed
/// over; without a kind a point is a point, a line a distance, a polygon an area; without errors values have no interval; heights that are
/// missing are 0. Throws Error (input_unreadable); for a system of coordinates other than `crs`, too, as far as both are known.
[[nodiscard]] std::vector<Measure> read_measures(const std::filesystem::path& path, const std::string& crs);

}  // namespace splatray
