/// The smooth surface that a mesh stands for where its corners' normals say so.
#pragma once
#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <span>

namespace splatray {

/// From a point of a triangle, given by its barycentric weights, to the smooth surface that its corners' unit normals are of: half way
/// to the mean of the corners' tangent planes (Boubekeur and Alexa 2008, "Phong Tessellation"; half is exact where the surface is a
/// quadric's graph). Each edge, from a corner to the next, has its own share in it, by the angle of the normals at its ends, so that
/// triangles join; edges that are not `joined` smoothly to another triangle have none.
[[nodiscard]] inline glm::dvec3 to_smooth_surface(const std::array<glm::dvec3, 3>& corners,
                                                  std::span<const glm::vec3, 3> normals,
                                                  const std::array<bool, 3>& joined,
                                                  const glm::dvec3& weights) {
  /// Cosines of 45 and 30 degrees: normals that turn by more along an edge are of a coarse drawing, not of a smooth surface.
  constexpr double SHARP_COSINE = 0.7071067811865476, SMOOTH_COSINE = 0.8660254037844387;
  glm::dvec3 sum(0.0);
  for (std::size_t i = 0; i < 3; ++i) {
    if (!joined[i]) continue;
    const std::size_t j = (i + 1) % 3;
    const glm::dvec3 normal_i(normals[i]), normal_j(normals[j]), along = corners[i] - corners[j];
    const double smooth = glm::smoothstep(SHARP_COSINE, SMOOTH_COSINE, glm::dot(normal_i, normal_j));
    sum += smooth * weights[static_cast<glm::length_t>(i)] * weights[static_cast<glm::length_t>(j)] *
           (glm::dot(along, normal_i) * normal_i - glm::dot(along, normal_j) * normal_j);
  }
  return 0.5 * sum;
}

}  // namespace splatray
