/// A splat's disc, and which cells it may meet.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

#include "engine/host/scene.h"

namespace splatray {

/// A disc in root space and the half-size of its bounding box.
struct Disc {
  explicit Disc(const Splat& splat);
  glm::dvec3 center;
  glm::dvec3 normal;
  glm::dvec3 half_box;
  double radius_squared;
};

/// Which children of a node a disc may come within LIST_INFLATION of: its bounding box against the inflated cell, its plane
/// against it and the distance of its centre from it. True for every child that it does come near, and for few others.
/// Children share what is worked out axis by axis.
class ChildTest {
 public:
  ChildTest(const Disc& disc, glm::uvec3 cell_min, std::uint32_t child_size)
      : radius_squared_(disc.radius_squared) {
    const double half = 0.5 * child_size + LIST_INFLATION;
    for (int axis = 0; axis < 3; ++axis) {
      for (std::uint32_t side = 0; side < 2; ++side) {
        const double offset = disc.center[axis] - (cell_min[axis] + side * child_size + 0.5 * child_size);
        const double outside = std::abs(offset) - half;
        const double gap = std::max(outside, 0.0);
        apart_[axis][side] = outside > disc.half_box[axis];
        along_normal_[axis][side] = disc.normal[axis] * offset;
        gap_squared_[axis][side] = gap * gap;
      }
    }
    const glm::dvec3 n = glm::abs(disc.normal);
    reach_ = half * (n.x + n.y + n.z);
  }

  /// The child on side x, y, z (0 or 1) of the node's middle.
  [[nodiscard]] bool may_meet(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
    if (apart_[0][x] || apart_[1][y] || apart_[2][z]) return false;
    if (std::abs(along_normal_[0][x] + along_normal_[1][y] + along_normal_[2][z]) > reach_) return false;
    return gap_squared_[0][x] + gap_squared_[1][y] + gap_squared_[2][z] <= radius_squared_;
  }

 private:
  double radius_squared_;
  double reach_;  // of the inflated cell along the disc's normal
  bool apart_[3][2];
  double along_normal_[3][2];
  double gap_squared_[3][2];
};

}  // namespace splatray
