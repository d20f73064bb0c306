/// The tree of all lights of a scene and of all splats that send out light, by which path tracing chooses one of them
/// (shaders/light/light_tree.glsl).
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "engine/light/emitters.h"
#include "engine/scene/look.h"

namespace splatray {

struct LightTree {
  std::vector<LightNode> nodes;  ///< depth first; empty where there is no light
  /// Where the nodes of the lights lie that have a size and are not at infinity.
  std::uint32_t sized_begin = 0, sized_end = 0;
};

/// Whether a light has a size and is not at infinity, so that rays may meet it among the scene.
[[nodiscard]] bool is_met(const Light& light);

/// The tree of lights in root space, which are given the number of their leaf, and of a scene's emitters. Nodes are divided where
/// the surface area orientation heuristic is least (Conty Estevez and Kulla 2018, "Importance Sampling of Many Lights with
/// Adaptive Tree Splitting", sec. 3.2); lights at infinity, those with a size and all others have a part of the tree each.
/// `two_sided`: of each object, whether light leaves both of its faces.
[[nodiscard]] LightTree light_tree(std::span<Light> lights, const Emitters& emitters,
                                   const std::vector<bool>& two_sided);

}  // namespace splatray
