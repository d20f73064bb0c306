/// Rays that look for trouble.
#pragma once
#include <vector>

#include "tests/property/dice.h"
#include "tests/trace/brute_force.h"

namespace splatray::testing {

/// Farthest origin of these rays from the root's centre, lattice units: beyond it brute force's first, coarse pass is no
/// longer sure in float64.
constexpr double FARTHEST_ORIGIN = 1U << 24U;

/// Rays in root space: from outside towards the scene, along the axes with zeros of both signs, along the lattice's
/// diagonals through its planes and corners, through centres and rims of splats, from on splats and in their planes, from
/// afar, with direction components down to denormal numbers; with any start and any mask of dielectrics they are inside of.
[[nodiscard]] std::vector<RayQuery> random_rays(const Scene& scene, const BruteForce& brute,
                                                std::size_t count, Dice& dice);

}  // namespace splatray::testing
