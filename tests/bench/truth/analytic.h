/// Shapes whose points and normals are known exactly: the unit sphere and the torus of data/models.h, float64.
#pragma once
#include <glm/glm.hpp>
#include <optional>

#include "engine/image/view.h"
#include "tests/bench/truth/truth.h"

namespace splatray::testing {

enum class Shape { sphere, torus };

/// The models `sphere` and `torus` of data/models.h, metres; the torus lies about the y axis.
inline constexpr double SPHERE_RADIUS = 1.0;
inline constexpr double TORUS_RING_RADIUS = 0.7;
inline constexpr double TORUS_TUBE_RADIUS = 0.3;

struct ShapeHit {
  double t;           ///< distance along the ray
  glm::dvec3 normal;  ///< unit, outwards
};

/// Where a ray from outside the shape first meets it; `dir` is unit. The torus' quartic is solved by bisection between the
/// extrema of its monotone pieces, so that no root is missed; t is exact to about 1e-14.
[[nodiscard]] std::optional<ShapeHit> first_hit(Shape shape, const glm::dvec3& origin, const glm::dvec3& dir);

/// The true picture of the shape, seen from outside it.
[[nodiscard]] Truth analytic_truth(Shape shape, const View& view);

/// Depth steps between neighbouring pixels that are wider than this many pixels are silhouettes, not slopes.
inline constexpr double JUMP_PIXELS = 10.0;

}  // namespace splatray::testing
