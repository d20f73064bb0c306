#include "preprocess/mesh/edges/clear_creases.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "preprocess/base/parallel.h"
#include "preprocess/mesh/edges/mesh_parts.h"

namespace splatray {
namespace {

constexpr double STANDS_OUT = 3.0;  // at 3.5 gears lose edges, at 2.5 coarse spheres with waves have some
constexpr int TWIG = 3;
constexpr double BENDS_OFF = 0.643;  // 50 degrees: around the end of a prism of 8 sides creases bend by 45
constexpr double LIKE_TURN = 1.3;  // at 1.15 gears and fandisk lose edges, at 1.6 statues keep twice as many

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

/// The vertices that a triangle's side joins.
std::array<glm::uint, 2> ends_of(const Mesh& mesh, std::uint32_t triangle, std::uint32_t side) {
  const glm::uvec3& t = mesh.triangles[triangle];
  const auto from = static_cast<glm::length_t>(side);
  return {t[from], t[(from + 1) % 3]};
}

glm::dvec3 along(const Mesh& mesh, std::uint32_t triangle, std::uint32_t side) {
  const auto [from, to] = ends_of(mesh, triangle, side);
  return mesh.vertices.position[to] - mesh.vertices.position[from];
}

double length_of(const Mesh& mesh, std::uint32_t triangle, std::uint32_t side) {
  return glm::length(along(mesh, triangle, side));
}

/// Absolute, and 0 of what has no length.
double cosine_between(const glm::dvec3& a, const glm::dvec3& b) {
  const double lengths = std::sqrt(glm::dot(a, a) * glm::dot(b, b));
  return lengths > 0.0 ? std::abs(glm::dot(a, b)) / lengths : 0.0;
}

/// An edge at one of its ends.
struct EdgeEnd {
  glm::uint place;
  std::uint32_t edge;
  glm::dvec3 away;  ///< from there to its other end

  bool operator<(const EdgeEnd& other) const {
    return std::tie(place, edge) < std::tie(other.place, other.edge);
  }
};

/// Both ends of the edges of these numbers, by place.
std::vector<EdgeEnd> ends_by_place(const Mesh& mesh, const std::vector<glm::uint>& weld,
                                   std::span<const TurningEdge> edges,
                                   const std::vector<std::uint32_t>& numbers) {
  std::vector<EdgeEnd> ends;
  for (const std::uint32_t n : numbers) {
    const auto [from, to] = ends_of(mesh, edges[n].triangle[0], edges[n].side[0]);
    const glm::dvec3 way = along(mesh, edges[n].triangle[0], edges[n].side[0]);
    ends.push_back({weld[from], n, way});
    ends.push_back({weld[to], n, -way});
  }
  std::sort(ends.begin(), ends.end());
  return ends;
}

/// Whether a crease goes on from one edge to another that meets it.
bool goes_on(std::span<const TurningEdge> edges, const EdgeEnd& a, const EdgeEnd& b) {
  const double turn_a = edges[a.edge].turn, turn_b = edges[b.edge].turn;
  return glm::dot(a.away, b.away) < 0.0 && cosine_between(a.away, b.away) > BENDS_OFF &&
         std::max(turn_a, turn_b) <= LIKE_TURN * std::min(turn_a, turn_b);
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
    const glm::dvec3 way = along(mesh, edge.triangle[0], edge.side[0]);
    double beside = 0.0;
    for (std::size_t half = 0; half < 2; ++half) {
      for (std::uint32_t side = 0; side < 3; ++side) {
        const std::uint32_t other = across[std::size_t{3} * edge.triangle[half] + side];
        if (side == edge.side[half] || other >= mesh.triangles.size()) continue;
        const double turn = turn_between(mesh, edge.triangle[half], other);
        if (turn > crease) continue;
        beside = std::max(beside, turn * cosine_between(way, along(mesh, edge.triangle[half], side)));
      }
    }
    stands[i] = edge.turn > STANDS_OUT * beside ? 1 : 0;
  });
  return stands;
}

std::vector<std::uint8_t> without_twigs(const Mesh& mesh, const std::vector<glm::uint>& weld,
                                        const std::vector<std::uint8_t>& on_border,
                                        std::span<const TurningEdge> edges) {
  std::vector<std::uint8_t> left(edges.size(), 1);
  for (int cut = 0; cut < TWIG; ++cut) {
    const auto numbers = numbers_where(edges.size(), [&](std::size_t i) { return left[i] != 0; });
    const std::vector<EdgeEnd> ends = ends_by_place(mesh, weld, edges, numbers);
    for (std::size_t begin = 0, end = 0; begin < ends.size(); begin = end) {
      while (end < ends.size() && ends[end].place == ends[begin].place) ++end;
      const bool alone = end - begin == 1;
      const bool pair = end - begin == 2 && !goes_on(edges, ends[begin], ends[begin + 1]);
      if (on_border[ends[begin].place] != 0 || !(alone || pair)) continue;
      for (std::size_t i = begin; i < end; ++i) left[ends[i].edge] = 0;
    }
  }
  return left;
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
