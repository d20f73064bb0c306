/// The truth of a picture: brute force over all splats and light transport in float64, written apart from the
/// shaders. Shares with them the definitions only: pixel positions and the random numbers that choose a
/// branch at glass.
#pragma once
#include "engine/image/image.h"
#include "engine/image/view.h"
#include "engine/scene/environment.h"
#include "tests/trace/brute_force.h"

namespace splatray::testing {

/// The picture as ARCHITECTURE.md defines hits (perspective cameras; blend, kernel, side as BruteForce). All
/// cores. `nudge` is added to the unit direction of each ray that leaves a hit: a path through glass multiplies
/// the last bits of its directions at each bounce, and pixels that a nudge of float32's rounding moves have no
/// truth that a renderer in float32 could meet.
[[nodiscard]] Image reference_picture(const Scene& scene, const BruteForce& brute, const View& view,
                                      const Settings& settings, const Environment& environment,
                                      const glm::dvec3& nudge = glm::dvec3(0.0));

}  // namespace splatray::testing
