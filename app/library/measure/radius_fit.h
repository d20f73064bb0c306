/// Spheres and cylinders through points of a surface.
#pragma once
#include <glm/glm.hpp>
#include <optional>
#include <span>

namespace splatray {

struct RadiusFit {
  double radius = 0.0;
  double radius_error = 0.0;  ///< standard deviation, from the residuals
  double residual = 0.0;      ///< root of the mean square of the points' distances from it
  glm::dvec3 center{0.0};     ///< of a cylinder: the point of its axis nearest to the points' middle
  glm::dvec3 axis{0.0};       ///< of a cylinder, unit; else 0
  std::size_t points = 0;     ///< that it was fitted to

  bool operator==(const RadiusFit&) const = default;
};

/// By least squares of the distances (Gauss-Newton), points farther off than three standard deviations left out in turn. Nothing where
/// the points do not determine it: fewer than 8, or nearly in a plane. `normals` beside the points, unit, of either side.
[[nodiscard]] std::optional<RadiusFit> fit_sphere(std::span<const glm::dvec3> points,
                                                  std::span<const glm::dvec3> normals);
[[nodiscard]] std::optional<RadiusFit> fit_cylinder(std::span<const glm::dvec3> points,
                                                    std::span<const glm::dvec3> normals);

}  // namespace splatray
