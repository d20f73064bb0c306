/// Measures at places as they are given.
#pragma once
#include "app/library/measure/measure_text.h"
#include "app/library/shot/scene_on_device.h"
#include "engine/image/region.h"

namespace splatray {

/// The measure of what the region holds of a scene, which has its pools. `shown` is the scene on a device and traces the
/// rays; not needed where all places are points. Throws Error (failed), one sentence, where a ray meets nothing, a place
/// lies farther than four spacings of its points from every surface (a place of a sphere or cylinder farther than its reach, too), or
/// what is around it is no sphere, cylinder or plane, or an area's outline crosses itself; of volumes as take_volume does.
[[nodiscard]] Measure take_measure(const Scene& scene, const Region& region, const GivenMeasure& given,
                                   SceneOnDevice* shown);

}  // namespace splatray
