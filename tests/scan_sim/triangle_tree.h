/// Rays through triangle meshes, for simulated scanners and true pictures.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <optional>
#include <vector>

#include "preprocess/points.h"

namespace splatray::testing {

/// Where a ray meets a triangle.
struct TriangleHit {
  double distance;    ///< in units of the direction's length
  glm::dvec3 normal;  ///< of the triangle's plane, unit, turned against the ray
  std::uint32_t triangle;
  glm::dvec3 weights;  ///< barycentric, of the triangle's corners
};

/// A hierarchy of boxes around a mesh's triangles, in float64; both faces are met.
class TriangleTree {
 public:
  explicit TriangleTree(Mesh mesh);

  /// The nearest triangle that the ray from `origin` along `dir` meets nearer than `limit`. Safe to call from many threads.
  [[nodiscard]] std::optional<TriangleHit> first_hit(
      const glm::dvec3& origin, const glm::dvec3& dir,
      double limit = std::numeric_limits<double>::infinity()) const;

  /// The smooth normal that preprocess gives to points there (normal_on_triangle), on the same side.
  [[nodiscard]] glm::dvec3 smooth_normal(const TriangleHit& hit) const;

  [[nodiscard]] const glm::dvec3& low() const { return nodes_.front().low; }
  [[nodiscard]] const glm::dvec3& high() const { return nodes_.front().high; }

 private:
  /// Depth first: one that is missed is passed over by going on at `next`.
  struct Node {
    glm::dvec3 low, high;
    std::uint32_t begin, end, next;
  };
  struct Triangle {
    glm::dvec3 a, ab, ac;
    std::uint32_t number;
  };
  void add_node(std::uint32_t begin, std::uint32_t end);

  Mesh mesh_;
  std::vector<glm::vec3> corners_;  ///< corner_normals
  std::vector<Triangle> triangles_;
  std::vector<Node> nodes_;
};

}  // namespace splatray::testing
