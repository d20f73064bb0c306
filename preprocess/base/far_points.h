/// Points that have nothing to do with the others: wild coordinates, a scanner's zeros beside a survey in world coordinates.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "preprocess/base/bounds.h"

namespace splatray {

/// The box of the points; sides that are not known (no points) end before they begin.
[[nodiscard]] Bounds bounds_of(const std::vector<glm::dvec3>& positions);

/// A handful of points far from all others.
struct FarPoints {
  std::vector<std::uint32_t> numbers;  ///< ascending
  double nearest_world = 0.0;          ///< how far the nearest and the farthest of them lie from `others`
  double farthest_world = 0.0;
  Bounds others{};  ///< of the other points
};

/// Finds the points that lie farther from the box of the others than 20 times its longest side, in the largest of the
/// three axes. They are at no more places than a thousandth of all points, but 16 where that is more and a twentieth where that
/// is less, or there are none: what is more is a part of the scene, however far. Points at one place count once, as scanners
/// write zeros for what did not return. Does not depend on the order of the points; costs little more than the bounds where
/// nothing is far. Positions must be finite.
[[nodiscard]] FarPoints find_far_points(const std::vector<glm::dvec3>& positions);

}  // namespace splatray
