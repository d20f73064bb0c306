/// A laser scanner, simulated: what one of its places sees of a surface.
#pragma once
#include <glm/glm.hpp>

#include "data/oriented_points.h"

namespace splatray {

/// Stands upright, y up, and measures along a grid of directions: rows of equal elevation, columns of equal azimuth.
struct Scanner {
  glm::dvec3 place{};      ///< m
  double step_rad = 1e-3;  ///< between rows and between columns, (0, 0.1)
  double noise_m = 0.0;    ///< standard deviation of a range
};

/// The points that the scanner measures on `surface`: of each direction the nearest, where the tangent plane of the surface's own nearest
/// point is met, off by the range's noise; none where the surface is grazed (cosine below 0.15), as no echo returns. `surface` needs some
/// four points for each direction. Colours stay, normals are the surface's. The same points give the same result.
[[nodiscard]] OrientedPoints scan(const OrientedPoints& surface, const Scanner& scanner);

}  // namespace splatray
