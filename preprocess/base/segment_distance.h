/// How far a place is from a straight line's piece.
#pragma once
#include <algorithm>
#include <glm/glm.hpp>

namespace splatray {

[[nodiscard]] inline double distance_squared(const glm::dvec3& place, const glm::dvec3& a,
                                             const glm::dvec3& b) {
  const glm::dvec3 along = b - a;
  const double squared = glm::dot(along, along);
  const double share = squared > 0.0 ? std::clamp(glm::dot(place - a, along) / squared, 0.0, 1.0) : 0.0;
  const glm::dvec3 from = place - (a + share * along);
  return glm::dot(from, from);
}

}  // namespace splatray
