/// Boxes around points.
#pragma once
#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

namespace splatray {

/// The smallest box around points; empty, from infinity to minus infinity, where there are none.
struct Bounds {
  glm::dvec3 low{INFINITY};
  glm::dvec3 high{-INFINITY};

  void add(const glm::dvec3& point) {
    low = glm::min(low, point);
    high = glm::max(high, point);
  }
  void add(const Bounds& other) {
    low = glm::min(low, other.low);
    high = glm::max(high, other.high);
  }
};

/// The length of the box's longest side.
[[nodiscard]] inline double longest_side(const Bounds& box) {
  const glm::dvec3 sides = box.high - box.low;
  return std::max({sides.x, sides.y, sides.z});
}

}  // namespace splatray
