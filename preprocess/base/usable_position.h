/// Which positions can be worked with.
#pragma once
#include <cmath>
#include <glm/glm.hpp>

namespace splatray {

/// Whether all coordinates are finite and at most 1e100, so that squares and sums of such stay finite in float64.
[[nodiscard]] inline bool is_usable_position(const glm::dvec3& position) {
  constexpr double LARGEST = 1e100;
  const auto in_range = [](double value) { return std::abs(value) <= LARGEST; };  // false on NaN
  return in_range(position.x) && in_range(position.y) && in_range(position.z);
}

}  // namespace splatray
