/// Meshes that simulated scanners look at, made in code.
#pragma once
#include "preprocess/points.h"

namespace splatray::testing {

/// The unit sphere about the origin, of 8 * 4^levels triangles.
[[nodiscard]] Mesh sphere_mesh(int levels);
/// A room of 12 x 9 m, 3.2 m high, z up, about the z axis on the floor z = 0, with eight round columns of 0.25 m, two tables
/// and a shelf.
[[nodiscard]] Mesh room_mesh();
/// 120 x 120 m of hills of 8 m about the origin, z up, with six houses of flat roofs and 4 m of walls.
[[nodiscard]] Mesh terrain_mesh();
/// A body without symmetry, of about 2 m and 80 000 triangles, with hollows and bumps: what range scans are made of.
[[nodiscard]] Mesh body_mesh();

}  // namespace splatray::testing
