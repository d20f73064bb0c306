#include "engine/device/device.h"
#include "engine/device/host/host_device.h"
#include "engine/device/vulkan/vulkan_device.h"

namespace splatray {

std::unique_ptr<Device> open_device(const std::string& wanted) {
  if (wanted == HOST_DEVICE) return std::make_unique<HostDevice>();
  return std::make_unique<VulkanDevice>(wanted);
}

std::vector<DeviceInfo> list_devices() { return vulkan_devices(); }

}  // namespace splatray
