/// How surfaces have moved between two scenes.
#pragma once
#include <cstdint>

#include "engine/base/progress.h"
#include "engine/device/device.h"
#include "engine/scene/scene.h"

namespace splatray {

/// What add_change found.
struct ChangeFound {
  std::uint64_t met = 0;      ///< splats whose line meets the other scene
  double median_world = 0.0;  ///< of the changes' sizes
  /// A size above which noise of both does not explain a change, 95 %; 0 = unknown.
  double significant_world = 0.0;
  std::uint64_t significant = 0;  ///< splats with a larger change
};

/// Gives each splat of `scene` the attribute COLUMN_CHANGE: how far its centre lies before (+) or behind (-) the surface of
/// `earlier`, which is the nearest one that the line along the splat's normal meets, blended and from either side; world
/// units, NaN where it meets none. Exact ray hits take the place of M3C2's cylinders (Lague et al. 2013). Throws Error
/// (interrupted) as `progress`, called with the stage "comparing", says.
ChangeFound add_change(Scene& scene, const Scene& earlier, const Device& device, const Progress& progress);

}  // namespace splatray
