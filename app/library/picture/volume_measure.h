/// Volumes at outlines and bases as they are given.
#pragma once
#include "app/library/measure/measure_text.h"
#include "engine/image/region.h"
#include "engine/scene/scene.h"

namespace splatray {

/// Gives a measure of kind volume, whose points are the outline or none, what the region holds over its base; without an outline also the
/// rectangle around that. The scene has its pools; an earlier one is read. Throws Error: failed, one sentence, where there is nothing or
/// the base is upright; input_unreadable for an earlier scan.
void take_volume(const Scene& scene, const Region& region, const GivenBase& base, Measure& measure);

}  // namespace splatray
