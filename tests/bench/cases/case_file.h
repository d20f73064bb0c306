/// What splatray-bench prepare found out about a case and splatray-bench cannot: the file case.json in the case's folder,
/// beside its scene files, truth.bin (truth.h) and environment.bin.
#pragma once
#include <filesystem>
#include <map>
#include <string>

#include "engine/image/view.h"
#include "engine/scene/environment.h"

namespace splatray::testing {

/// About one scene file.
struct PreparedVariant {
  double build_s = 0.0;              ///< wall time of normals, radii, octree and insertion, seconds
  double overlap = 0.0;              ///< sum of disc areas / surface area; 0 = unknown
  double radius_median_world = 0.0;  ///< of the discs
};

struct PreparedCase {
  Camera camera;
  double diagonal_world = 0.0;                      ///< of the bounding box of the default's splats
  std::string truth;                                ///< "analytic", "mesh" or empty = there is no truth.bin
  std::map<std::string, PreparedVariant> variants;  ///< by file name
};

/// Writes folder/case.json: {"camera": {"eye": [x, y, z], "target": .., "up": .., "fov_y_deg": ..}, "diagonal_world": ..,
/// "truth": .., "variants": {FILE: {"build_s": .., "overlap": .., "radius_median_world": ..}}}. Throws Error (failed).
void write_case(const PreparedCase& prepared, const std::filesystem::path& folder);
/// Reads it back. Throws Error (input_unreadable) naming the file.
[[nodiscard]] PreparedCase read_case(const std::filesystem::path& folder);

/// An environment as a plain binary file in this machine's byte order: uint32 width and height, then the constant and the
/// texels, three float32 each. The engine reads no picture files. Throws Error (failed).
void write_environment(const Environment& environment, const std::filesystem::path& path);
/// Reads it back. Throws Error (input_unreadable).
[[nodiscard]] Environment read_environment_file(const std::filesystem::path& path);

}  // namespace splatray::testing
