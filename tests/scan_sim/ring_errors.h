/// How well splats of a spinning scanner's rings join to surfaces.
#pragma once
#include "engine/scene/scene.h"
#include "tests/scan_sim/scanner.h"
#include "tests/scan_sim/triangle_tree.h"

namespace splatray::testing {

struct RingErrors {
  /// Of rays from the sensor to surfaces between its rings, within 40 world units: those that meet nothing, or something
  /// further than 7 % + 0.05 from the surface.
  double stripes_percent = 0.0;
  /// The same from 3 units above and behind the sensor, to what it sees too.
  double stripes_above_percent = 0.0;
  /// Rays that were left out: within a ring's step the surface ends or bends, and the rings do not show where.
  double edges_percent = 0.0;
  double overlap = 0.0;  ///< area of all splats over what they cover
};

/// By brute force in float64, with `rays` rays, evenly spread over the sensor's sphere between the lowest and highest ring.
[[nodiscard]] RingErrors ring_errors(const Scene& scene, const TriangleTree& truth, const Spinner& spinner,
                                     std::uint32_t rays);

/// The area of all splats over what they cover: each point of a splat counts once over the splats that it lies on, to within a
/// quarter of the radius. By `points` points at random.
[[nodiscard]] double overlap_of(const Scene& scene, std::uint32_t points);

}  // namespace splatray::testing
