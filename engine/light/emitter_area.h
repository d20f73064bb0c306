/// Area of the surface that each splat represents.
#pragma once
#include <span>
#include <vector>

#include "engine/scene/splat.h"

namespace splatray {

/// Of each splat its area less what it shares: a point that lies on n of them is 1 / n of each. Lattice units^2, about, and at
/// least a thousandth of its disc; where there are many, a usual share of each disc. `clips`: the clip word of each, or empty.
[[nodiscard]] std::vector<float> areas_alone(std::span<const Splat> splats,
                                             std::span<const std::uint32_t> clips);

}  // namespace splatray
