/// Which triangles of a mesh meet smoothly at an edge, and where its surface ends or has a crease.
#pragma once
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <tuple>
#include <vector>

#include "preprocess/points.h"

namespace splatray {

class MeshEdges {
 public:
  /// A side of a triangle, known by the two places that it joins.
  struct Side {
    std::uint64_t places;
    std::uint32_t triangle, side;

    bool operator<(const Side& other) const {
      return std::tie(places, triangle, side) < std::tie(other.places, other.triangle, other.side);
    }
  };

  static constexpr std::uint32_t NONE = 0xFFFFFFFFU;

  /// `weld` is weld_positions of the vertices, `corners` corner_normals. An edge ends the surface where one triangle has it, or
  /// more than two; it is a crease where two triangles turn by more than the angle of `crease_cosine`, and their corners have
  /// different normals there: what is shaded smoothly is no crease. Triangles without area join whatever they touch. Edges that
  /// do not stand out of a curved surface (standing_out) are none, nor are creases that do not go on (without_twigs) or are too
  /// short, all together, to bound anything on their part of the mesh (bounding).
  MeshEdges(const Mesh& mesh, const std::vector<glm::uint>& weld, const std::vector<glm::vec3>& corners,
            double crease_cosine);

  /// Those of a mesh whose creases are known: `ends`, asked of a triangle and a side of it, is true where the surface has one.
  MeshEdges(const Mesh& mesh, const std::vector<glm::uint>& weld,
            const std::function<bool(std::uint32_t, std::uint32_t)>& ends);

  /// Whether the surface ends or has a crease anywhere.
  [[nodiscard]] bool any() const { return any_; }
  /// The triangle across the edge from corner `side` to the next one; NONE where the surface ends or has a crease.
  [[nodiscard]] std::uint32_t across(std::uint32_t triangle, std::uint32_t side) const {
    const std::uint32_t found = beside_[std::size_t{3} * triangle + side];
    return (found & END) != 0 ? NONE : found;
  }
  /// The same also where the surface has a crease; the triangle itself where it ends, and NONE at an edge of more than two.
  [[nodiscard]] std::uint32_t beside(std::uint32_t triangle, std::uint32_t side) const {
    const std::uint32_t found = beside_[std::size_t{3} * triangle + side];
    return found == NONE ? NONE : found & ~END;
  }
  [[nodiscard]] std::size_t triangles() const { return beside_.size() / 3; }

 private:
  static constexpr std::uint32_t END = 0x80000000U;  ///< beside what is not joined smoothly

  void pair_up(std::span<const Side> edge);
  std::uint32_t& beside_side(const Side& side);

  std::vector<std::uint32_t> beside_;  ///< of each triangle's sides: beside(), with END
  bool any_ = false;
};

}  // namespace splatray
