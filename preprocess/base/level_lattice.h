/// Which node of an octree of points a place lies in.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>

namespace splatray {

/// Where points lie in the root's cube, in fractions of 2^BITS of its edge: what decides which node a point is of, the same in all steps.
/// The edge is a power of two.
struct LevelLattice {
  static constexpr unsigned BITS = 30;

  glm::dvec3 low{0.0};  ///< the cube's lowest corner, world units
  double edge = 1.0;    ///< world units

  /// Points beside the cube lie in its outermost cells.
  [[nodiscard]] glm::uvec3 place(const glm::dvec3& position) const {
    // The edge is a power of two, the corner a multiple of cells: nothing is rounded but down to the cell.
    constexpr auto CELLS = static_cast<double>(1U << BITS);
    const double cells_a_unit = CELLS / edge;
    return glm::uvec3(glm::clamp(glm::floor(position * cells_a_unit) - low * cells_a_unit, 0.0, CELLS - 1.0));
  }
  /// The cell of a place among those of a level <= BITS.
  [[nodiscard]] static glm::uvec3 cell(const glm::uvec3& place, unsigned level) {
    return place >> (BITS - level);
  }
};

}  // namespace splatray
