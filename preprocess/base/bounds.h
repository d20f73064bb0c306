/// Boxes around points.
#pragma once
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

}  // namespace splatray
