#include "engine/device/device_profile.h"

#include <algorithm>

#include "engine/base/error.h"

namespace splatray {
namespace {

bool runs_cpu_kernels(const Context& context) {
  return context.float64 && context.ballot && pool_limits(context).texel_elements > 0;
}

}  // namespace

ThreadWork DeviceProfile::work(std::uint32_t path_rays, std::uint32_t lights) const {
  const std::uint32_t fit = std::max(rays_most / path_rays, 2U) - 1;
  const std::uint32_t lights_at_once = std::clamp(std::min(fit, lights_most), 1U, std::max(lights, 1U));
  if (lights > lights_at_once) return {1, lights_at_once};
  const std::uint32_t rays = path_rays * (1 + lights_at_once);
  return {std::clamp(rays_most / rays, 1U, path_rays > 1 ? paths_most : samples_most), lights_at_once};
}

DeviceProfile device_profile(const Context& context, Kernels requested) {
  if (context.is_host()) return {.kernels = Kernels::host, .culls = true};
  const bool able = runs_cpu_kernels(context);
  if (requested == Kernels::cpu && !able)
    throw Error(ExitCode::failed,
                "found a device without float64, ballots or texel buffers, expected all three "
                "for the kernels of CPU devices");
  const bool cpu = requested == Kernels::automatic ? context.is_cpu() && able : requested == Kernels::cpu;
  DeviceProfile profile;
  profile.kernels = cpu ? Kernels::cpu : Kernels::gpu;
  if (context.is_cpu()) {
    // Mesa's llvmpipe silently ends all loops of a thread after 65 535 iterations in all (loops_were_cut): about 40 for a ray of
    // a sphere of 2000 splats, 150 for one of a scan of a million.
    profile.samples_most = 16;
    profile.paths_most = 1;
    profile.rays_most = 128;
    profile.culls = profile.stages = cpu;
  } else {
    // A dispatch of more would take long enough for drivers that stop long work.
    profile.lights_most = 256;
  }
  return profile;
}

}  // namespace splatray
