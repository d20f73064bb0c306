/// Normals of triangle meshes.
#pragma once
#include <glm/glm.hpp>
#include <vector>

#include "preprocess/points.h"

namespace splatray {

/// Cosine of 30 degrees, BuildParams::crease_degrees.
inline constexpr double DEFAULT_CREASE_COSINE = 0.86602540378443865;

/// For each position the index of the first position equal to it (-0 equals +0; NaN equals nothing).
[[nodiscard]] std::vector<glm::uint> weld_positions(const std::vector<glm::dvec3>& positions);

/// Unit normal of each vertex: the given one, or where that is absent, zero or not finite, the sum of the
/// normals of all triangles at that position weighted by their angles there (Thuermer and Wuethrich 1998,
/// "Computing Vertex Normals from Polygonal Facets"); zero for vertices no proper triangle uses and
/// where the triangles nearly cancel (a flap folded onto itself, a sheet with both faces). `weld` is
/// weld_positions of the vertices.
[[nodiscard]] std::vector<glm::vec3> vertex_normals(const Mesh& mesh, const std::vector<glm::uint>& weld);

/// Unit normals of each triangle's three corners, 3 * triangles: the given one, or the angle-weighted sum
/// over those triangles at the corner that turn less than the angle of `crease_cosine` from this one, so that creases stay
/// sharp.
[[nodiscard]] std::vector<glm::vec3> corner_normals(const Mesh& mesh, const std::vector<glm::uint>& weld,
                                                    double crease_cosine = DEFAULT_CREASE_COSINE);

/// Unit normal at the point of a triangle with these barycentric weights: its three `corners` (corner_normals)
/// interpolated, at most 20 degrees from the triangle's own; zero where they cancel.
[[nodiscard]] glm::vec3 normal_on_triangle(const Mesh& mesh, const std::vector<glm::vec3>& corners,
                                           std::size_t triangle, const glm::dvec3& weights);

/// Turns the mesh inside out: winding and given normals.
void flip_mesh(Mesh& mesh);

}  // namespace splatray
