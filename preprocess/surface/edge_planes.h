/// The planes that a neighbourhood of points consists of, and the lines at which they end.
#pragma once
#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

namespace splatray {

/// A point's surroundings, in units of its spacing.
struct Around {
  static constexpr std::size_t MOST = 24;

  std::array<glm::dvec3, MOST> offset;
  std::size_t count = 0;

  /// Distance of the farthest neighbour.
  [[nodiscard]] double reach() const { return glm::length(offset[count - 1]); }
};

/// The line that a plane shares with another, seen from the point.
struct Line {
  glm::dvec3 out;         ///< unit, in the plane, square to the line, away from the plane's own points
  glm::dvec3 other{0.0};  ///< normal of the plane behind it; zero at a border
  double distance;        ///< from the point
};

/// One plane of a point, and the lines that its disc ends at.
struct Side {
  glm::dvec3 normal;
  std::array<Line, 2> lines;
  std::size_t count = 0;
};

/// The sides of a point near a crease, those that it lies on; none where the evidence is not clear. `around` keeps the nearest of
/// its neighbours, as many as show them. `crease`: the least turn, radians.
[[nodiscard]] std::vector<Side> find_sides(Around& around, double crease);

/// Whether one plane holds the point and all its neighbours.
[[nodiscard]] bool is_flat(const Around& around);

}  // namespace splatray
