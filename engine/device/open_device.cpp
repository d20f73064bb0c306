#include <algorithm>

#include "engine/base/error.h"
#include "engine/device/device.h"
#include "engine/device/host/host_device.h"
#include "engine/device/vulkan/vulkan_device.h"

namespace splatray {

std::unique_ptr<Device> open_device(const std::string& wanted) { return open_device(wanted, {}); }

std::unique_ptr<Device> open_device(const std::string& wanted, const DeviceNeeds& wishes) {
  if (wanted == HOST_DEVICE) return std::make_unique<HostDevice>();
  try {
    auto vulkan = std::make_unique<VulkanDevice>(wanted, false, wishes);
    if (!wanted.empty() || !vulkan->is_cpu()) return vulkan;
  } catch (const Error& error) {
    if (!wanted.empty() || error.code() != ExitCode::no_device) throw;
    const std::vector<DeviceInfo> devices =
        vulkan_devices();  // throws where Vulkan must not be asked, after a fork
    const auto usable = [](const DeviceInfo& info) { return info.refused.empty(); };
    if (std::any_of(devices.begin(), devices.end(), usable)) throw;
  }
  return std::make_unique<HostDevice>();
}

std::vector<DeviceInfo> list_devices() { return vulkan_devices(); }

}  // namespace splatray
