#include "preprocess/mesh/edges/mesh_edges.h"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "preprocess/base/parallel.h"
#include "preprocess/mesh/edges/clear_creases.h"

namespace splatray {
namespace {

constexpr float COS_SAME_SURFACE = 0.985F;  // 10 degrees: normals of corners that are shaded as one surface

using EdgeSide = MeshEdges::Side;

std::vector<EdgeSide> sorted_sides(const Mesh& mesh, const std::vector<glm::uint>& weld) {
  std::vector<EdgeSide> sides(3 * mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::uint32_t side = 0; side < 3; ++side) {
      const auto index = static_cast<glm::length_t>(side);
      const std::uint64_t a = weld[mesh.triangles[t][index]], b = weld[mesh.triangles[t][(index + 1) % 3]];
      sides[3 * std::size_t{t} + side] = {std::min(a, b) << 32 | std::max(a, b), t, side};
    }
  }
  tbb::parallel_sort(sides.begin(), sides.end());
  return sides;
}

/// What is asked of pairs of triangles.
class CreaseTest {
 public:
  CreaseTest(const Mesh& mesh, const std::vector<glm::uint>& weld, const std::vector<glm::vec3>& corners,
             double cosine)
      : mesh_(mesh), weld_(weld), corners_(corners), cosine_(cosine) {}

  [[nodiscard]] bool smooth(const EdgeSide& a, const EdgeSide& b) const {
    const auto [normal_a, normal_b] = normals(a, b);
    const double lengths = std::sqrt(glm::dot(normal_a, normal_a) * glm::dot(normal_b, normal_b));
    return !(glm::dot(normal_a, normal_b) < cosine_ * lengths) || shaded_as_one(a, b);
  }

  /// By how much the surface turns, radians.
  [[nodiscard]] double turn(const EdgeSide& a, const EdgeSide& b) const {
    const auto [normal_a, normal_b] = normals(a, b);
    return std::atan2(glm::length(glm::cross(normal_a, normal_b)), glm::dot(normal_a, normal_b));
  }

 private:
  /// On one side of the surface.
  [[nodiscard]] std::pair<glm::dvec3, glm::dvec3> normals(const EdgeSide& a, const EdgeSide& b) const {
    return {normal(a.triangle), normal(b.triangle) * (start(a) == start(b) ? -1.0 : 1.0)};
  }
  [[nodiscard]] glm::dvec3 normal(std::uint32_t triangle) const {
    const auto& p = mesh_.vertices.position;
    const glm::uvec3& t = mesh_.triangles[triangle];
    return glm::cross(p[t.y] - p[t.x], p[t.z] - p[t.x]);
  }
  /// The place where a triangle's side begins.
  [[nodiscard]] glm::uint start(const EdgeSide& side) const {
    return weld_[mesh_.triangles[side.triangle][static_cast<glm::length_t>(side.side)]];
  }
  [[nodiscard]] const glm::vec3& corner(std::uint32_t triangle, std::uint32_t which) const {
    return corners_[std::size_t{3} * triangle + which % 3];
  }
  [[nodiscard]] bool shaded_as_one(const EdgeSide& a, const EdgeSide& b) const {
    const bool same_way = start(a) == start(b);
    const auto same = [](const glm::vec3& m, const glm::vec3& n) {
      return std::abs(glm::dot(m, n)) > COS_SAME_SURFACE;
    };
    return same(corner(a.triangle, a.side), corner(b.triangle, b.side + (same_way ? 0 : 1))) &&
           same(corner(a.triangle, a.side + 1), corner(b.triangle, b.side + (same_way ? 1 : 0)));
  }

  const Mesh& mesh_;
  const std::vector<glm::uint>& weld_;
  const std::vector<glm::vec3>& corners_;
  double cosine_;
};

/// The two sides of a crease, and by how much the surface turns there, radians.
struct Crease {
  EdgeSide a, b;
  double turn;
};

std::vector<TurningEdge> turning_edges(const std::vector<Crease>& creases) {
  std::vector<TurningEdge> edges;
  for (const Crease& crease : creases)
    edges.push_back({{crease.a.triangle, crease.b.triangle}, {crease.a.side, crease.b.side}, crease.turn});
  return edges;
}

std::vector<Crease> creases_where(const std::vector<Crease>& creases, const std::vector<std::uint8_t>& kept) {
  return gather(creases, numbers_where(creases.size(), [&](std::size_t i) { return kept[i] != 0; }));
}

/// Calls use(sides of an edge) for each edge.
template <typename Use>
void for_each_joint(const Mesh& mesh, const std::vector<glm::uint>& weld, const Use& use) {
  const std::vector<EdgeSide> sides = sorted_sides(mesh, weld);
  for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    while (end < sides.size() && sides[end].places == sides[begin].places) ++end;
    use(std::span(sides).subspan(begin, end - begin));
  }
}

}  // namespace

std::uint32_t& MeshEdges::beside_side(const EdgeSide& side) {
  return beside_[std::size_t{3} * side.triangle + side.side];
}

/// Joins the triangles at an edge of two.
void MeshEdges::pair_up(std::span<const EdgeSide> edge) {
  any_ = any_ || edge.size() != 2;
  if (edge.size() == 1) beside_side(edge[0]) = edge[0].triangle | END;
  if (edge.size() == 2) beside_side(edge[0]) = edge[1].triangle, beside_side(edge[1]) = edge[0].triangle;
}

MeshEdges::MeshEdges(const Mesh& mesh, const std::vector<glm::uint>& weld,
                     const std::vector<glm::vec3>& corners, double crease_cosine)
    : beside_(3 * mesh.triangles.size(), NONE) {
  const CreaseTest test(mesh, weld, corners, crease_cosine);
  std::vector<Crease> creases;
  std::vector<std::uint8_t> on_border(weld.size());
  for_each_joint(mesh, weld, [&](std::span<const EdgeSide> edge) {
    pair_up(edge);
    if (edge.size() != 2)
      on_border[edge[0].places >> 32] = on_border[static_cast<std::uint32_t>(edge[0].places)] = 1;
    else if (!test.smooth(edge[0], edge[1]))
      creases.push_back({edge[0], edge[1], test.turn(edge[0], edge[1])});
  });
  const auto keep = [&](const std::vector<std::uint8_t>& kept) { creases = creases_where(creases, kept); };
  keep(standing_out(mesh, beside_, turning_edges(creases), std::acos(crease_cosine)));
  keep(without_twigs(mesh, weld, on_border, turning_edges(creases)));
  keep(bounding(mesh, beside_, turning_edges(creases)));
  for (const Crease& crease : creases)
    for (const EdgeSide& side : {crease.a, crease.b}) beside_side(side) |= END;
  any_ = any_ || !creases.empty();
}

MeshEdges::MeshEdges(const Mesh& mesh, const std::vector<glm::uint>& weld,
                     const std::function<bool(std::uint32_t, std::uint32_t)>& ends)
    : beside_(3 * mesh.triangles.size(), NONE) {
  for_each_joint(mesh, weld, [&](std::span<const EdgeSide> edge) {
    pair_up(edge);
    if (edge.size() != 2 || !ends(edge[0].triangle, edge[0].side)) return;
    for (const EdgeSide& side : edge) beside_side(side) |= END;
    any_ = true;
  });
}

}  // namespace splatray
