// What Vulkan's devices are given to do.
#include "engine/device/vulkan/vulkan_device.h"

namespace splatray {

DeviceProfile VulkanDevice::profile() const {
  DeviceProfile profile;
  if (is_cpu()) {
    // Mesa's llvmpipe silently ends all loops of a thread after 65 535 iterations in all (loops_were_cut): about 40 for a ray of
    // a sphere of 2000 splats, 150 for one of a scan of a million.
    profile.samples_most = 16;
    profile.paths_most = 1;
    profile.rays_most = 128;
    profile.slow = true;
  } else {
    // A dispatch of more would take long enough for drivers that stop long work.
    profile.lights_most = 256;
    // The host makes the next one ready meanwhile. A processor's driver would run the dispatches at which a person no longer looks.
    profile.in_flight = IN_FLIGHT_MOST;
  }
  return profile;
}

}  // namespace splatray
