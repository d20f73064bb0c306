#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>

#include "engine/base/error.h"
#include "engine/device/bindings.h"
#include "engine/device/vulkan/vulkan_device.h"
#include "shaders/layout.h"

namespace splatray {
namespace {

const char* type_name(VkPhysicalDeviceType type) {
  switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
      return "discrete GPU";
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
      return "integrated GPU";
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
      return "virtual GPU";
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
      return "CPU";
    default:
      return "other";
  }
}

/// Place in the order of preference, 0 is best.
std::size_t rank(const DeviceInfo& device) {
  constexpr const char* ORDER[] = {"discrete GPU", "integrated GPU", "virtual GPU", "other", "CPU"};
  return static_cast<std::size_t>(std::find(std::begin(ORDER), std::end(ORDER), device.type) -
                                  std::begin(ORDER));
}

std::string version_text(std::uint32_t version) {
  return std::to_string(VK_API_VERSION_MAJOR(version)) + "." + std::to_string(VK_API_VERSION_MINOR(version)) +
         "." + std::to_string(VK_API_VERSION_PATCH(version));
}

std::string reason_to_refuse(VkPhysicalDevice device, const VkPhysicalDeviceProperties& properties) {
  if (properties.apiVersion < VK_API_VERSION_1_2)
    return "Vulkan " + version_text(properties.apiVersion) + " found, 1.2 needed";
  if (compute_queue_family(device) == UINT32_MAX) return "no compute queue";
  const VkPhysicalDeviceLimits& limits = properties.limits;
  if (limits.maxPerStageDescriptorStorageBuffers < OTHER_STORAGE_BUFFERS)
    return std::to_string(limits.maxPerStageDescriptorStorageBuffers) +
           " storage buffers in a shader found, " + std::to_string(OTHER_STORAGE_BUFFERS) + " needed";
  if (limits.maxComputeWorkGroupInvocations < GROUP_SIZE)
    return "work groups of " + std::to_string(limits.maxComputeWorkGroupInvocations) + " found, " +
           std::to_string(GROUP_SIZE) + " needed";
  return "";
}

bool contains_ignoring_case(const std::string& text, const std::string& part) {
  const auto same = [](unsigned char a, unsigned char b) { return std::tolower(a) == std::tolower(b); };
  return std::search(text.begin(), text.end(), part.begin(), part.end(), same) != text.end();
}

/// The device number that `wanted` spells, if it is one of `count`.
std::optional<std::size_t> device_number(const std::string& wanted, std::size_t count) {
  std::size_t number = 0;
  const char* end = wanted.data() + wanted.size();
  const auto [stop, error] = std::from_chars(wanted.data(), end, number);
  if (error != std::errc{} || stop != end || number >= count) return std::nullopt;
  return number;
}

Error no_device_error(const std::vector<DeviceInfo>& devices, const std::string& wanted,
                      const std::string& said) {
  if (devices.empty())
    return {ExitCode::no_device,
            "no Vulkan device found" + (said.empty() ? "" : " (" + said + ")") +
                ", at least one driver expected (Debian's package mesa-vulkan-drivers has drivers for most "
                "GPUs and one for the CPU; the device 'cpu' needs none)"};
  std::string sentence =
      wanted.empty() ? "no Vulkan device is usable" : "no usable Vulkan device matches '" + wanted + "'";
  for (std::size_t i = 0; i < devices.size(); ++i) {
    sentence += (i == 0 ? ", found " : "; ") + std::to_string(i) + ": " + devices[i].name + " (" +
                (devices[i].refused.empty() ? "usable" : "refused: " + devices[i].refused) + ")";
  }
  return {ExitCode::no_device, sentence};
}

}  // namespace

std::uint32_t compute_queue_family(VkPhysicalDevice device) {
  std::uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
  for (std::uint32_t i = 0; i < count; ++i)
    if ((families[i].queueFlags & VK_QUEUE_COMPUTE_BIT) != 0) return i;
  return UINT32_MAX;
}

DeviceInfo describe_device(VkPhysicalDevice device) {
  VkPhysicalDeviceProperties properties{};
  vkGetPhysicalDeviceProperties(device, &properties);
  DeviceInfo info;
  info.name = properties.deviceName;
  info.type = type_name(properties.deviceType);
  info.api = version_text(properties.apiVersion);
  info.refused = reason_to_refuse(device, properties);
  if (properties.apiVersion < VK_API_VERSION_1_2) {
    info.driver = "version " + std::to_string(properties.driverVersion);
    return info;
  }
  VkPhysicalDeviceDriverProperties driver{};
  driver.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES;
  VkPhysicalDeviceProperties2 chain{};
  chain.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
  chain.pNext = &driver;
  vkGetPhysicalDeviceProperties2(device, &chain);
  info.driver = std::string(driver.driverName) + " " + driver.driverInfo;
  return info;
}

std::size_t choose_device(const std::vector<DeviceInfo>& devices, const std::string& wanted,
                          const std::string& said) {
  const std::optional<std::size_t> number = device_number(wanted, devices.size());
  std::size_t best = devices.size();
  for (std::size_t i = 0; i < devices.size(); ++i) {
    const bool matches = number ? i == *number : contains_ignoring_case(devices[i].name, wanted);
    if (!matches || !devices[i].refused.empty()) continue;
    if (best == devices.size() || rank(devices[i]) < rank(devices[best])) best = i;
  }
  if (best == devices.size()) throw no_device_error(devices, wanted, said);
  return best;
}

}  // namespace splatray
