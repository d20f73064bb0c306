/// Directions as two integers on an octahedron.
#pragma once
#include <cstdlib>
#include <glm/glm.hpp>

namespace splatray {

/// The integer vector (u, v, w), |u| + |v| + |w| = scale, of two octahedral coordinates; without branches, for loops.
[[nodiscard]] inline glm::dvec3 octahedral_vector(int u, int v, int scale) {
  const int w = scale - std::abs(u) - std::abs(v);
  const int fold = w < 0 ? -w : 0;
  return {u < 0 ? u + fold : u - fold, v < 0 ? v + fold : v - fold, w};
}
/// The octahedral coordinates of a direction, of any length but 0, in [-scale, scale], not rounded.
[[nodiscard]] glm::dvec2 octahedral_exact(const glm::dvec3& normal, int scale);

/// The two octahedral coordinates, of the four around the exact ones, whose direction is nearest the normal
/// ("precise" encoding, Cigolle et al. 2014, sec. 3.3); those of each direction that coordinates stand for are always the same.
[[nodiscard]] glm::ivec2 octahedral_nearest(const glm::dvec3& normal, int scale);

}  // namespace splatray
