/// How far pictures of scans are from those of the meshes that were scanned.
#pragma once
#include "engine/scene/scene.h"
#include "tests/scan_sim/triangle_tree.h"

namespace splatray::testing {

/// Over the pixels of the pictures along +z and -z, by brute force in float64 against the exact triangles.
struct PictureErrors {
  double normal_p95_deg = 0.0;  ///< where both show something
  double normal_p99_deg = 0.0;
  double depth_p95 = 0.0;       ///< the same pixels, in units of the mesh's diagonal
  double beyond_percent = 0.0;  ///< pixels that show a surface where there is none, of all
  double holes_percent = 0.0;   ///< pixels that show none where there is a surface, of all
};

/// Pictures of size x size pixels of a mesh's box, from +z and from -z, 30 degrees of view.
[[nodiscard]] PictureErrors picture_errors(const Scene& scene, const TriangleTree& truth, std::uint32_t size);

}  // namespace splatray::testing
