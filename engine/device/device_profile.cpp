#include "engine/device/device_profile.h"

#include <algorithm>

namespace splatray {

ThreadWork DeviceProfile::work(std::uint32_t path_rays, std::uint32_t lights) const {
  const std::uint32_t fit = std::max(rays_most / path_rays, 2U) - 1;
  const std::uint32_t lights_at_once = std::clamp(std::min(fit, lights_most), 1U, std::max(lights, 1U));
  if (lights > lights_at_once) return {1, lights_at_once};
  const std::uint32_t rays = path_rays * (1 + lights_at_once);
  return {std::clamp(rays_most / rays, 1U, path_rays > 1 ? paths_most : samples_most), lights_at_once};
}

}  // namespace splatray
