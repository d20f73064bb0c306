/// How large the discs of a surface are.
#pragma once
#include "engine/image/region.h"
#include "engine/scene/scene.h"

namespace splatray {

/// Radius of the discs of the region, on the median of some of them, world units; 0 = it has none. The scene has its pools.
[[nodiscard]] double disc_radius(const Scene& scene, const Region& region);

}  // namespace splatray
