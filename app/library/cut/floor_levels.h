/// Heights of floors and ceilings, and of storeys.
#pragma once
#include <vector>

#include "engine/image/region.h"
#include "engine/scene/scene.h"

namespace splatray {

/// The heights along `up` (unit) at which a level plane holds much of what is level in the region, ascending, world units: a tenth of its
/// area or more within 1 cm to either side, the median of what is there. `unit_metres`: length of a world unit.
[[nodiscard]] std::vector<double> floor_levels(const Scene& scene, const Region& region, const glm::dvec3& up,
                                               double unit_metres);

/// The heights along `up` (unit) of the floors that are a storey each, ascending, world units: levels that face up, of at least a tenth of
/// the largest one's area. What lies less than `above` over the floor beneath, as tables and landings do, is seen in a plan that is cut
/// so high, and is none. Land has none: there are floors where within 15 cm of them half of all lies that is level and faces up.
[[nodiscard]] std::vector<double> storey_floors(const Scene& scene, const Region& region,
                                                const glm::dvec3& up, double unit_metres, double above);

}  // namespace splatray
