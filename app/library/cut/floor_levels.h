/// Heights of floors and ceilings.
#pragma once
#include <vector>

#include "engine/image/region.h"
#include "engine/scene/scene.h"

namespace splatray {

/// The heights along `up` (unit) at which a level plane holds much of what is level in the region, ascending, world units: a tenth of its
/// area or more within 1 cm to either side, the median of what is there. `unit_metres`: length of a world unit.
[[nodiscard]] std::vector<double> floor_levels(const Scene& scene, const Region& region, const glm::dvec3& up,
                                               double unit_metres);

}  // namespace splatray
