/// The scans that preprocess is measured with.
#pragma once
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tests/scan_sim/scanner.h"

namespace splatray::testing {

/// A scan and what is true of it.
struct ScanCase {
  std::string name;
  SimulatedScan scan;                        ///< truths that are not known are zero normals
  std::shared_ptr<const TriangleTree> mesh;  ///< for pictures; null = none are compared
  glm::dvec3 up{0.0, 0.0, 1.0};
  std::optional<Spinner> spinner{};                ///< of sweeps whose rings are judged, and
  std::shared_ptr<const TriangleTree> rings_of{};  ///< what they are of
};

/// One sweep of `rings` rings along a street.
[[nodiscard]] ScanCase street_sweep(int rings);

/// The corner of corner_mesh as a depth camera sees it from 1.4 m above the floor, whose grid and rounding are `camera`'s.
[[nodiscard]] SimulatedScan corner_by_depth_camera(DepthCamera camera = {});

/// The same without stations, or without normals of its own.
[[nodiscard]] ScanCase without_stations(ScanCase scan_case);
[[nodiscard]] ScanCase without_normals(ScanCase scan_case);

/// Simulated scans of meshes made in code: a room from two places, its corner by a depth camera, hills from the air, a body by ten range images.
[[nodiscard]] std::vector<ScanCase> built_in_cases();
/// Scans of the models in a data folder, and real ones whose truth is known: with and without stations and normals. Those
/// whose files are absent or of a format that is not read are left out.
[[nodiscard]] std::vector<ScanCase> data_cases(const std::filesystem::path& folder);

}  // namespace splatray::testing
