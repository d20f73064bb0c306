/// Shading by depth alone: what lies behind what is beside it is darker (eye-dome lighting: Boucheny 2009, "Visualisation
/// scientifique de grands volumes de donnees: pour une approche perceptive", section 4.3).
#pragma once
#include <span>
#include <vector>

#include "engine/image/view.h"

namespace splatray {

/// What eye_dome.glsl takes for a view of the whole picture; `strength` as eye_dome has it.
struct DomeScale {
  float exponent;   ///< <= 0
  float per_world;  ///< > 0: orthographic
};
[[nodiscard]] DomeScale dome_scale(const View& view, double strength);

/// A factor 0..1 for each pixel of a view of the whole picture, from the distances that its pixels show, world units; what is not
/// finite or not above 0 shows nothing and gets 1. `strength` 0 = none, 1 = as it suits most scans. As strong at all sizes of a
/// picture.
[[nodiscard]] std::vector<float> eye_dome(std::span<const float> distance_world, const View& view,
                                          double strength);

}  // namespace splatray
