/// Directions of vectors that may have none.
#pragma once
#include <cmath>
#include <glm/glm.hpp>

namespace splatray {

/// The vector's direction, unit; zero where its length is zero or not finite.
[[nodiscard]] inline glm::dvec3 unit_or_zero(const glm::dvec3& vector) {
  const double length = glm::length(vector);
  return length > 0.0 && std::isfinite(length) ? vector / length : glm::dvec3(0.0);
}

}  // namespace splatray
