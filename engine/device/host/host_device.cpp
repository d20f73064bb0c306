#include "engine/device/host/host_device.h"

#include "engine/device/host/host_queue.h"

namespace splatray {

const DeviceInfo& HostDevice::info() const {
#ifdef __clang__
  constexpr const char* COMPILER = "C++ by " __VERSION__;
#else
  constexpr const char* COMPILER = "C++ by GCC " __VERSION__;
#endif
  static const DeviceInfo INFO{"the host's CPU, without Vulkan", "CPU", COMPILER, "", ""};
  return INFO;
}

const DeviceLimits& HostDevice::limits() const {
  static constexpr DeviceLimits LIMITS{
      .storage_bytes = std::uint64_t{UINT32_MAX} * sizeof(uvec4),  // what 32 bits number
      .allocation_bytes = UINT64_MAX,
      .storage_buffers = POOLS,
      .texture_size = UINT16_MAX};
  return LIMITS;
}

DeviceProfile HostDevice::profile() const { return {.slow = true}; }

std::unique_ptr<Queue> HostDevice::make_queue(const QueueOptions& options) const {
  return std::make_unique<HostQueue>(options.threads, options.vector_bits);
}

}  // namespace splatray
