/// The shaders as C++: the same GLSL text (shaders/*.glsl), compiled by the host compiler, on the same scene.
/// What a GPU answers differently is the GPU's or its compiler's doing.
#pragma once
#include <array>
#include <span>
#include <vector>

#include "engine/image/view.h"
#include "engine/scene/scene.h"

namespace splatray::testing {

/// The features a pipeline is specialised by, indexed by SPEC_*.
using Features = std::array<std::uint32_t, SPEC_COUNT>;

/// Features for a scene and settings with everything the shaders can do switched on (a superset of what the
/// tracer picks).
[[nodiscard]] Features twin_features(const Scene& scene, const Settings& settings);

/// Answers ray queries as shaders/stage/rays.comp.glsl does.
[[nodiscard]] std::vector<RayHit> twin_intersect(const Scene& scene, std::span<const RayQuery> rays,
                                                 const Settings& settings);

}  // namespace splatray::testing
