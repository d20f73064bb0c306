#include "tests/scan_sim/triangle_tree.h"

#include <algorithm>
#include <cmath>

#include "preprocess/base/bounds.h"
#include "preprocess/mesh/mesh_normals.h"

namespace splatray::testing {
namespace {

using glm::dvec3;

constexpr std::uint32_t LEAF = 4;

/// Whether the ray comes into the box nearer than `limit`. NaN, of a ray in a face, counts as a hit.
bool meets(const dvec3& low, const dvec3& high, const dvec3& origin, const dvec3& inverse, double limit) {
  const dvec3 a = (low - origin) * inverse, b = (high - origin) * inverse;
  const dvec3 near = glm::min(a, b), far = glm::max(a, b);
  const double enter = std::max({near.x, near.y, near.z, 0.0});
  const double leave = std::min({far.x, far.y, far.z, limit});
  return !(enter > leave);
}

}  // namespace

TriangleTree::TriangleTree(Mesh mesh)
    : mesh_(std::move(mesh)), corners_(corner_normals(mesh_, weld_positions(mesh_.vertices.position))) {
  for (std::uint32_t i = 0; i < mesh_.triangles.size(); ++i) {
    const glm::uvec3& corners = mesh_.triangles[i];
    const dvec3& a = mesh_.vertices.position[corners.x];
    const Triangle triangle{a, mesh_.vertices.position[corners.y] - a, mesh_.vertices.position[corners.z] - a,
                            i};
    if (glm::length(glm::cross(triangle.ab, triangle.ac)) > 0.0) triangles_.push_back(triangle);
  }
  add_node(0, static_cast<std::uint32_t>(triangles_.size()));
}

void TriangleTree::add_node(std::uint32_t begin, std::uint32_t end) {
  const std::size_t self = nodes_.size();
  Bounds bounds, middles;
  const auto middle = [](const Triangle& t) { return t.a + (t.ab + t.ac) / 3.0; };
  for (std::uint32_t i = begin; i < end; ++i) {
    const Triangle& t = triangles_[i];
    for (const dvec3& corner : {t.a, t.a + t.ab, t.a + t.ac}) bounds.add(corner);
    middles.add(middle(t));
  }
  nodes_.push_back({bounds.low, bounds.high, begin, end, 0});
  if (end - begin > LEAF) {
    const dvec3 extent = middles.high - middles.low;
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
    const std::uint32_t half = begin + (end - begin) / 2;
    std::nth_element(triangles_.begin() + begin, triangles_.begin() + half, triangles_.begin() + end,
                     [&](const Triangle& s, const Triangle& t) { return middle(s)[axis] < middle(t)[axis]; });
    add_node(begin, half);
    add_node(half, end);
  }
  nodes_[self].next = static_cast<std::uint32_t>(nodes_.size());
}

std::optional<TriangleHit> TriangleTree::first_hit(const dvec3& origin, const dvec3& dir,
                                                   double limit) const {
  const dvec3 inverse = 1.0 / dir;
  std::optional<TriangleHit> hit;
  for (std::uint32_t n = 0; n < nodes_.size();) {
    const Node& node = nodes_[n];
    if (!meets(node.low, node.high, origin, inverse, limit)) {
      n = node.next;
      continue;
    }
    const bool leaf = node.next == n + 1;
    for (std::uint32_t i = node.begin; leaf && i < node.end; ++i) {  // Moeller, Trumbore 1997
      const Triangle& t = triangles_[i];
      const dvec3 p = glm::cross(dir, t.ac);
      const double determinant = glm::dot(t.ab, p);
      const dvec3 from_a = origin - t.a;
      const double u = glm::dot(from_a, p) / determinant;
      const dvec3 q = glm::cross(from_a, t.ab);
      const double v = glm::dot(dir, q) / determinant;
      const double distance = glm::dot(t.ac, q) / determinant;
      if (!(u >= 0.0 && v >= 0.0 && u + v <= 1.0 && distance > 0.0 && distance < limit)) continue;
      const dvec3 normal = glm::normalize(glm::cross(t.ab, t.ac));
      limit = distance;
      hit = TriangleHit{
          distance, glm::dot(normal, dir) > 0.0 ? -normal : normal, t.number, {1.0 - u - v, u, v}};
    }
    ++n;
  }
  return hit;
}

dvec3 TriangleTree::smooth_normal(const TriangleHit& hit) const {
  const dvec3 normal(normal_on_triangle(mesh_, corners_, hit.triangle, hit.weights));
  return glm::dot(normal, hit.normal) < 0.0 ? -normal : normal;
}

}  // namespace splatray::testing
