/// Meshes that simulated scanners look at, made in code.
#pragma once
#include "preprocess/points.h"

namespace splatray::testing {

/// The unit sphere about the origin, of 8 * 4^levels triangles.
[[nodiscard]] Mesh sphere_mesh(int levels);
/// A room of 12 x 9 m, 3.2 m high, z up, about the z axis on the floor z = 0, with eight round columns of 0.25 m, two tables
/// and a shelf.
[[nodiscard]] Mesh room_mesh();
/// A wall of 3 x 2 m along x in the middle of a floor of 4 x 3 m, z up.
[[nodiscard]] Mesh wall_mesh(double thickness);
/// 120 x 120 m of hills of 8 m about the origin, z up, with six houses of flat roofs and 4 m of walls.
[[nodiscard]] Mesh terrain_mesh();
/// 160 x 160 m of a street along x, z up: ground that rises a little to the sides, kerbs, houses, parked cars, poles and signs.
[[nodiscard]] Mesh street_mesh();
/// A wood on a hill: 60 x 60 m about the origin that rise by 0.4, z up, with 80 crowns of 2000 leaves, each of 0.03 m^2.
struct Wood {
  Mesh mesh;
  std::uint32_t first_leaf;  ///< of the triangles; those before are the ground
};
[[nodiscard]] Wood wood_mesh();
/// A body without symmetry, of about 2 m and 80 000 triangles, with hollows and bumps: what range scans are made of.
[[nodiscard]] Mesh body_mesh();

/// A corner of a room, z up: the floor z = 0 and the walls x = 0 and y = 0, 4 m each, and on the floor a ball and a box; what
/// depth cameras look at.
[[nodiscard]] Mesh corner_mesh();
inline constexpr double CORNER_BALL_RADIUS = 0.35;
inline const glm::dvec3 CORNER_BALL{1.5, 1.3, 0.35};

}  // namespace splatray::testing
