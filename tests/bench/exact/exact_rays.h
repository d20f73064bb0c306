/// Rays of every kind that answers are compared on.
#pragma once
#include <array>
#include <string_view>
#include <vector>

#include "engine/image/region.h"
#include "tests/property/dice.h"
#include "tests/trace/brute_force.h"

namespace splatray::testing {

/// What follows other rays' hits: their kinds.
enum class Next { shadow, mirrored, refracted };

/// Of each true hit the ray that the shaders would send: to a light in direction `to_light` where the hit faces it; mirrored; or
/// refracted, totally reflected where it cannot be.
[[nodiscard]] std::vector<RayQuery> following_rays(const Scene& scene, const std::vector<RayQuery>& rays,
                                                   const std::vector<TrueHit>& hits, Next next,
                                                   const glm::dvec3& to_light);

/// From anywhere within a root's edge of the root's middle, in any direction.
[[nodiscard]] std::vector<RayQuery> rays_from_anywhere(std::size_t count, Dice& dice);

/// A part of the scene: what is before one to three planes, in a turned box, or before a plane and out of a box.
[[nodiscard]] Region random_region(const Scene& scene, Dice& dice);

/// Kinds that look for trouble.
inline constexpr std::array<std::string_view, 8> ADVERSARIAL{
    "along the lattice",         ///< parallel to axes and diagonals, zeros of both signs, in planes of cells
    "corner to corner",          ///< from a lattice point to another
    "tiny components",           ///< along an axis but for components of 1e-45 to 1e-7
    "from splats",               ///< from a disc's centre, where t = 0 is no hit
    "from splats, in plane",     ///< and along the disc
    "nearly in a disc's plane",  ///< at 1e-9 to 0.1 radians to it
    "at rims",                   ///< at the edge of a disc, beside it by 0 or 1e-9 to 1e-3 radii
    "from afar",                 ///< from up to 8 root edges away
};
/// `kind` is one of ADVERSARIAL.
[[nodiscard]] std::vector<RayQuery> adversarial_rays(std::string_view kind, const BruteForce& brute,
                                                     std::size_t count, Dice& dice);

}  // namespace splatray::testing
