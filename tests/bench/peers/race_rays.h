/// The kinds of rays that a scene is raced in.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "engine/image/view.h"
#include "engine/scene/scene.h"
#include "tests/bench/cases/random_rays.h"

namespace splatray::testing {

/// Rays of one kind: a frame of primary rays, or a list.
struct RaceRays {
  std::string kind;
  std::uint32_t samples = 0;   ///< a pixel of the frame; 0 = a list
  std::vector<RayQuery> list{};  ///< root space
  bool any = false;            ///< whether anything lies on them, not what comes first
  bool coherent = true;        ///< neighbours in the list go about the same way
};

/// "frame" and "four", of 1 and 4 samples a pixel; and of the hits of `primary`, which `hits` answers: "mirrored" rays, and "shadow"
/// rays to a directional light above the eye's left from each hit that faces it, any hit of these; then "random", as many as pixels,
/// from all around towards a place in the scene's box each, and "occluded", any hit of the same.
[[nodiscard]] std::vector<RaceRays> race_rays(const Scene& scene, const std::vector<RayQuery>& primary,
                                              const std::vector<RayHit>& hits);

}  // namespace splatray::testing
