/// Rays mirrored again and again in shapes where the exact path is known.
#pragma once
#include <cstdint>

#include "engine/scene/scene.h"
#include "tests/bench/cases/random_rays.h"

namespace splatray::testing {

struct Bounces {
  std::uint64_t counted = 0;
  std::uint64_t wrong = 0;
};

/// Paths between the two one-sided mirrors of the model `wedge`, sent in through its opening, at most MOST_BOUNCES long. A
/// path is wrong when it has not as many bounces as between two exact planes. Paths that come within 3 median radii of the
/// mirrors' outer borders, where discs end as they do, or meet a mirror at less than 0.06 degree are not counted.
[[nodiscard]] Bounces wedge_bounces(const Intersect& intersect, const RootTransform& root, double wedge_deg,
                                    double radius_world, std::size_t paths);

/// Bounces inside the model `sphere` turned inside out, MOST_BOUNCES of each path, which starts anywhere inside. A bounce is
/// wrong when its ray misses or ends more than 2 median radii from where it meets the exact sphere; the path ends there.
[[nodiscard]] Bounces ball_bounces(const Intersect& intersect, const RootTransform& root, double radius_world,
                                   std::size_t paths);

inline constexpr std::uint32_t MOST_BOUNCES = 16;

}  // namespace splatray::testing
