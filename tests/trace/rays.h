/// Rays for tests: through a scene from outside, and on from what they hit.
#pragma once
#include <cstdint>
#include <vector>

#include "engine/scene/scene.h"
#include "tests/trace/brute_force.h"

namespace splatray::testing {

/// Primary rays from random points outside the root (0.6 to 3 root edges from its centre) towards random
/// points of the box of the splats' centres. Unit directions, root space.
[[nodiscard]] std::vector<RayQuery> random_primary_rays(const Scene& scene, std::size_t count,
                                                        std::uint64_t seed);

/// For each ray that hits: its mirrored ray, a diffuse (random hemisphere) ray, or, on a dielectric, the
/// refracted or totally reflected ray, as the shaders would send them, in turn.
[[nodiscard]] std::vector<RayQuery> secondary_rays(const Scene& scene, const std::vector<RayQuery>& rays,
                                                   const std::vector<TrueHit>& hits, std::uint64_t seed);

/// brute.nearest for every ray, on all cores.
[[nodiscard]] std::vector<TrueHit> all_nearest(const BruteForce& brute, const std::vector<RayQuery>& rays,
                                               const Settings& settings);

}  // namespace splatray::testing
