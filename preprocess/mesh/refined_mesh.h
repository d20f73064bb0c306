/// A mesh whose triangles are divided until they follow its smooth surface.
#pragma once
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "preprocess/mesh/edges/mesh_edges.h"
#include "preprocess/mesh/smooth_surface.h"
#include "preprocess/points.h"

namespace splatray {

/// The parts of a mesh's triangles, which join as these do: places and texture coordinates alone. Sides are halved where their
/// middles lie further from the surface than asked, so that both triangles at a side divide it alike.
class RefinedMesh {
 public:
  /// `tolerance_world`: how far facets may lie off the smooth surface.
  RefinedMesh(const Mesh& mesh, const MeshEdges& edges, const SmoothSurface& surface, double tolerance_world);

  [[nodiscard]] const Mesh& mesh() const { return refined_; }
  /// Which parts meet smoothly; `weld` is weld_positions of mesh()'s vertices.
  [[nodiscard]] MeshEdges edges(const std::vector<glm::uint>& weld) const;
  /// The part of a triangle that has these barycentric weights in it.
  [[nodiscard]] std::uint32_t part_at(std::uint32_t triangle, const glm::dvec3& weights) const;
  [[nodiscard]] std::uint32_t triangle_of(std::uint32_t part) const { return parts_[part].triangle; }
  /// A place on a part in its triangle.
  [[nodiscard]] glm::dvec3 weights_of(std::uint32_t part, const glm::dvec3& weights) const;

 private:
  struct Corner {
    glm::dvec3 weights;  ///< barycentric, in the triangle
    glm::uint vertex;
  };
  struct Part {
    std::uint32_t triangle;
    std::array<glm::dvec3, 3> corners;  ///< barycentric weights in it
  };

  void divide(const SmoothTriangle& smooth, std::uint32_t triangle, const std::array<Corner, 3>& corners);
  [[nodiscard]] Corner middle_of(const SmoothTriangle& smooth, std::uint32_t triangle, const Corner& a,
                                 const Corner& b);
  [[nodiscard]] bool ends(std::uint32_t part, std::uint32_t side) const;

  const Mesh& mesh_;
  const MeshEdges& edges_;
  double tolerance_;
  Mesh refined_;
  std::vector<Part> parts_;           ///< beside the refined triangles
  std::vector<std::uint32_t> begin_;  ///< of each triangle's parts, and where the last one's end
};

}  // namespace splatray
