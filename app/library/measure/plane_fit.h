/// Planes through points of a surface.
#pragma once
#include <cstddef>
#include <glm/glm.hpp>
#include <optional>
#include <span>

namespace splatray {

struct PlaneFit {
  glm::dvec3 middle{0.0};  ///< of the points, on the plane
  glm::dvec3 normal{0.0};  ///< unit, to either side
  double residual = 0.0;   ///< root of the mean square of the points' distances from it
  /// Standard deviation of the normal's direction, radians, about the axis that it is least sure of.
  double turn_error = 0.0;
  std::size_t points = 0;  ///< that it was fitted to

  bool operator==(const PlaneFit&) const = default;
};

/// By least squares of the distances, points farther off than three standard deviations left out in turn. The error follows from
/// the residuals and from how far the points reach. Nothing where the points do not determine it: fewer than 8, or nearly in a line.
[[nodiscard]] std::optional<PlaneFit> fit_plane(std::span<const glm::dvec3> points);

}  // namespace splatray
