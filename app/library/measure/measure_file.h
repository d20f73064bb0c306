/// Measures in files of others: GeoJSON (RFC 7946, but in the file's own coordinates), DXF, tables.
#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "app/library/measure/measure.h"

namespace splatray {

/// What all measures of a file share.
struct MeasureFrame {
  glm::dvec3 up{0.0, 0.0, 1.0};
  std::string crs{};  ///< Scene::crs
};

[[nodiscard]] std::string geojson_text(std::span<const Measure> measures, const MeasureFrame& frame);
/// Lines, points and circles with their values as text, on one layer a kind.
[[nodiscard]] std::string dxf_text(std::span<const Measure> measures, const MeasureFrame& frame);
/// Comma-separated: number, kind, name, value, within (95 %), unit.
[[nodiscard]] std::string csv_text(std::span<const Measure> measures, const MeasureFrame& frame);

/// Throws Error (usage) for a name that ends in none of .geojson, .dxf and .csv.
void require_measures_name(const std::filesystem::path& path);
/// Writes them in the format of the name. Throws Error: as require_measures_name, and failed.
void write_measures(std::span<const Measure> measures, const MeasureFrame& frame,
                    const std::filesystem::path& path);
/// Reads what geojson_text wrote, the values anew from its points. Throws Error (input_unreadable).
[[nodiscard]] std::vector<Measure> read_measures(const std::filesystem::path& path);

}  // namespace splatray
