/// Which triangles of a mesh meet smoothly at an edge, and where its surface ends or has a crease.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "preprocess/points.h"

namespace splatray {

class MeshEdges {
 public:
  static constexpr std::uint32_t NONE = 0xFFFFFFFFU;

  static constexpr int TWIG = 3;

  /// `weld` is weld_positions of the vertices, `corners` corner_normals. An edge ends the surface where one triangle has it, or
  /// more than two; it is a crease where two triangles turn by more than the angle of `crease_cosine`, and their corners have
  /// different normals there: what is shaded smoothly is no crease. Triangles without area join whatever they touch. Edges that
  /// do not stand out of a curved surface (standing_out) are none. Creases of at most TWIG edges that end on both sides in the
  /// midst of the surface, as noise has them, are none; longer ones lose TWIG edges where they end. Nor are those that are too
  /// short, all together, to bound anything on their part of the mesh (bounding).
  MeshEdges(const Mesh& mesh, const std::vector<glm::uint>& weld, const std::vector<glm::vec3>& corners,
            double crease_cosine);

  /// Whether the surface ends or has a crease anywhere.
  [[nodiscard]] bool any() const { return any_; }
  /// The triangle across the edge from corner `side` to the next one; NONE where the surface ends or has a crease.
  [[nodiscard]] std::uint32_t across(std::uint32_t triangle, std::uint32_t side) const {
    return across_[std::size_t{3} * triangle + side];
  }
  [[nodiscard]] std::size_t triangles() const { return across_.size() / 3; }

 private:
  std::vector<std::uint32_t> across_;
  bool any_ = false;
};

}  // namespace splatray
