/// What differs between kinds of devices in how much they are given to do; each says so itself (vulkan/vulkan_profile.cpp has the
/// measured reasons).
#pragma once
#include <cstdint>

#include "shaders/layout.h"

namespace splatray {

/// Work of one thread in one dispatch.
struct ThreadWork {
  std::uint32_t samples = 1;  ///< of a pixel, >= 1
  std::uint32_t lights = 1;   ///< at each hit, >= 1
};

struct DeviceProfile {
  bool slow = false;                        ///< a processor's: a sample of a large tile takes seconds
  std::uint32_t samples_most = UINT32_MAX;  ///< of a pixel in a dispatch, of one ray each and its shadow rays
  std::uint32_t paths_most = UINT32_MAX;    ///< of a pixel in a dispatch, of several rays each
  std::uint32_t rays_most = UINT32_MAX;     ///< of a thread in a dispatch
  std::uint32_t lights_most = LIGHTS_MOST;  ///< of a dispatch
  /// Dispatches that are handed over before the first is waited for, at most IN_FLIGHT_MOST.
  std::uint32_t in_flight = 1;

  /// The most work of a thread whose paths have up to `path_rays` rays, >= 1, and meet `lights` lights.
  [[nodiscard]] ThreadWork work(std::uint32_t path_rays, std::uint32_t lights) const;
};

}  // namespace splatray
