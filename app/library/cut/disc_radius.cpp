#include "app/library/cut/disc_radius.h"

#include <vector>

#include "engine/base/rank.h"
#include "engine/scene/scene_splat.h"

namespace splatray {

double disc_radius(const Scene& scene, const Region& region) {
  constexpr std::size_t SOME = 1U << 16U;
  const std::size_t every = splat_count(scene) / SOME + 1;
  std::vector<double> radii;
  for_each_splat(scene, [&](std::size_t i, const SceneSplat& splat) {
    if (i % every == 0 && region.holds(splat.center_world())) radii.push_back(splat.radius_world());
  });
  return radii.empty() ? 0.0 : value_at(radii, 0.5);
}

}  // namespace splatray
