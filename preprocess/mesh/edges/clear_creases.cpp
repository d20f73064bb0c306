#include "preprocess/mesh/edges/clear_creases.h"

#include <algorithm>
#include <cmath>

#include "preprocess/base/parallel.h"
#include "preprocess/mesh/edges/mesh_parts.h"

namespace splatray {
namespace {

constexpr double STANDS_OUT = 2.5;

/// Square to a triangle, twice its area long.
glm::dvec3 normal_of(const Mesh& mesh, std::uint32_t triangle) {
  const auto& p = mesh.vertices.position;
  const glm::uvec3& t = mesh.triangles[triangle];
  return glm::cross(p[t.y] - p[t.x], p[t.z] - p[t.x]);
}

/// Between two triangles, however they are wound, radians.
double turn_between(const Mesh& mesh, std::uint32_t a, std::uint32_t b) {
  const glm::dvec3 normal_a = normal_of(mesh, a), normal_b = normal_of(mesh, b);
  return std::atan2(glm::length(glm::cross(normal_a, normal_b)), std::abs(glm::dot(normal_a, normal_b)));
}

double length_of(const Mesh& mesh, std::uint32_t triangle, std::uint32_t side) {
  const glm::uvec3& t = mesh.triangles[triangle];
  const auto from = static_cast<glm::length_t>(side);
  return glm::distance(mesh.vertices.position[t[from]], mesh.vertices.position[t[(from + 1) % 3]]);
}

/// What is measured of a part.
struct PartSize {
  double area = 0.0, edges = 0.0;  ///< its borders' length, and creases'
};

std::vector<PartSize> measure_parts(const Mesh& mesh, TrianglesAcross across, const MeshParts& parts) {
  std::vector<PartSize> sizes(parts.count);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    PartSize& size = sizes[parts.of[t]];
    size.area += 0.5 * glm::length(normal_of(mesh, t));
    for (std::uint32_t side = 0; side < 3; ++side)
      if (across[std::size_t{3} * t + side] >= mesh.triangles.size()) size.edges += length_of(mesh, t, side);
  }
  return sizes;
}

}  // namespace

std::vector<std::uint8_t> standing_out(const Mesh& mesh, TrianglesAcross across,
                                       std::span<const TurningEdge> edges, double crease) {
  std::vector<std::uint8_t> stands(edges.size());
  tbb::parallel_for(std::size_t{0}, edges.size(), [&](std::size_t i) {
    const TurningEdge& edge = edges[i];
    double beside = 0.0;
    for (std::size_t half = 0; half < 2; ++half) {
      for (std::uint32_t side = 0; side < 3; ++side) {
        const std::uint32_t other = across[std::size_t{3} * edge.triangle[half] + side];
        if (side == edge.side[half] || other >= mesh.triangles.size()) continue;
        const double turn = turn_between(mesh, edge.triangle[half], other);
        if (turn <= crease) beside = std::max(beside, turn);
      }
    }
    stands[i] = edge.turn > STANDS_OUT * beside ? 1 : 0;
  });
  return stands;
}

std::vector<std::uint8_t> bounding(const Mesh& mesh, TrianglesAcross across,
                                   std::span<const TurningEdge> edges) {
  if (edges.empty()) return {};
  const MeshParts parts = find_parts(mesh.triangles.size(), [&](std::uint32_t t, std::uint32_t side) {
    return across[std::size_t{3} * t + side];
  });
  std::vector<PartSize> sizes = measure_parts(mesh, across, parts);
  const auto size_of = [&](const TurningEdge& edge) -> PartSize& {
    return sizes[parts.of[edge.triangle[0]]];
  };
  for (const TurningEdge& edge : edges)
    size_of(edge).edges += length_of(mesh, edge.triangle[0], edge.side[0]);
  std::vector<std::uint8_t> bound(edges.size());
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const PartSize& size = size_of(edges[i]);
    bound[i] = size.edges * size.edges >= size.area ? 1 : 0;
  }
  return bound;
}

}  // namespace splatray
