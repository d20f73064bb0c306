/// Light through clear dielectrics of exact shape, both branches at each boundary, in float64.
#pragma once
#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

namespace splatray::testing {

/// Where a line is inside a convex body.
struct Crossing {
  double t_in, t_out;
  glm::dvec3 normal_in, normal_out;  ///< unit, outwards
};

/// A convex dielectric.
struct Body {
  double ior;
  std::function<std::optional<Crossing>(const glm::dvec3& origin, const glm::dvec3& dir)> cross;
};

[[nodiscard]] Body sphere_body(const glm::dvec3& center, double radius, double ior);

/// A half space {x : normal . x <= offset}, normal unit.
struct HalfSpace {
  glm::dvec3 normal;
  double offset;
};
[[nodiscard]] Body convex_body(std::vector<HalfSpace> planes, double ior);

/// Radiance along a ray (unit direction) that starts outside all bodies, under an environment. Of bodies that overlap, the
/// later in the list fills the place (Schmidt and Budge 2002, "Simple Nested Dielectrics in Ray Traced Images").
/// Paths that carry less than 1e-5 end.
[[nodiscard]] glm::dvec3 expected_radiance(
    const std::vector<Body>& bodies, const glm::dvec3& origin, const glm::dvec3& dir,
    const std::function<glm::dvec3(const glm::dvec3& dir)>& environment);

}  // namespace splatray::testing
