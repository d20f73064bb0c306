#include "engine/device/vulkan/vulkan_device.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <memory>
#include <type_traits>

#include "engine/base/error.h"

namespace splatray {
namespace {

using MessageCount = std::atomic<std::uint32_t>;

/// Counts a validation message in *user_data, a MessageCount, and prints it.
VKAPI_ATTR VkBool32 VKAPI_CALL on_message(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                          VkDebugUtilsMessageTypeFlagsEXT,
                                          const VkDebugUtilsMessengerCallbackDataEXT* data, void* user_data) {
  ++*static_cast<MessageCount*>(user_data);
  std::cerr << "Vulkan validation: " << data->pMessage << '\n';
  return VK_FALSE;
}

VkDebugUtilsMessengerCreateInfoEXT messenger_info(MessageCount* count) {
  VkDebugUtilsMessengerCreateInfoEXT info{};
  info.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
  info.messageSeverity =
      VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  info.messageType =
      VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
  info.pfnUserCallback = on_message;
  info.pUserData = count;
  return info;
}

bool validation_in_environment() {
  const char* value = std::getenv("SPLATRAY_VALIDATION");
  return value != nullptr && std::strcmp(value, "1") == 0;
}

std::uint32_t queue_count(VkPhysicalDevice device, std::uint32_t family) {
  std::uint32_t count = family + 1;
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
  return families[family].queueCount;
}

DeviceLimits device_limits(const VkPhysicalDeviceLimits& limits, std::uint64_t allocation_bytes) {
  const std::uint32_t buffers =
      std::min(limits.maxPerStageDescriptorStorageBuffers, limits.maxDescriptorSetStorageBuffers);
  return {.storage_bytes = limits.maxStorageBufferRange,
          .allocation_bytes = allocation_bytes,
          .storage_buffers = std::max(buffers, OTHER_STORAGE_BUFFERS) - OTHER_STORAGE_BUFFERS,
          .texture_size = limits.maxImageDimension2D};
}

}  // namespace

void check(VkResult result, const char* what) {
  if (result == VK_SUCCESS) return;
  if (result == VK_ERROR_OUT_OF_DEVICE_MEMORY)
    throw Error(ExitCode::out_of_memory, std::string(what) + " failed: the device is out of memory");
  if (result == VK_ERROR_OUT_OF_HOST_MEMORY)
    throw Error(ExitCode::out_of_memory, std::string(what) + " failed: the driver is out of host memory");
  const std::string reason =
      result == VK_ERROR_DEVICE_LOST ? "the device was lost" : "VkResult " + std::to_string(result);
  throw Error(ExitCode::failed, std::string(what) + " failed: " + reason);
}

std::vector<DeviceInfo> vulkan_devices() {
  if (!vulkan_is_installed()) return {};
  refuse_vulkan_of_parent();
  const VulkanStart started = start_vulkan();
  const auto destroy = [](VkInstance instance) { vkDestroyInstance(instance, nullptr); };
  const std::unique_ptr<std::remove_pointer_t<VkInstance>, decltype(destroy)> instance(started.instance,
                                                                                       destroy);
  std::vector<DeviceInfo> infos;
  for (VkPhysicalDevice device : started.devices) infos.push_back(describe_device(device));
  return infos;
}

VulkanDevice::VulkanDevice(const std::string& wanted, bool validation, const DeviceNeeds& needs) {
  try {
    const VulkanStart started = start(validation || validation_in_environment(), needs);
    choose_device(started, wanted, needs);
    create_device(needs);
  } catch (...) {
    destroy();
    throw;
  }
}

VulkanDevice::~VulkanDevice() { destroy(); }

VulkanStart VulkanDevice::start(bool validation, const DeviceNeeds& needs) {
  refuse_vulkan_of_parent();
  if (validation && !validation_layer_present())
    throw Error(ExitCode::failed, std::string("validation was asked for, but the layer ") + VALIDATION_LAYER +
                                      " is not installed (Debian's package vulkan-validationlayers)");
  const VkDebugUtilsMessengerCreateInfoEXT messenger = messenger_info(&validation_messages_);
  VulkanStart started = start_vulkan(validation ? &messenger : nullptr, needs.instance_extensions);
  instance = started.instance;
  if (validation && instance != VK_NULL_HANDLE) create_messenger();
  return started;
}

void VulkanDevice::create_messenger() {
  const auto create = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
      vkGetInstanceProcAddr(instance, "vkCreateDebugUtilsMessengerEXT"));
  const VkDebugUtilsMessengerCreateInfoEXT info = messenger_info(&validation_messages_);
  check(create(instance, &info, nullptr, &messenger_), "listening to the validation layer");
}

void VulkanDevice::choose_device(const VulkanStart& started, const std::string& wanted,
                                 const DeviceNeeds& needs) {
  std::vector<DeviceInfo> infos;
  for (VkPhysicalDevice candidate : started.devices) {
    infos.push_back(describe_device(candidate));
    if (infos.back().refused.empty() && needs.refusal && !needs.optional)
      infos.back().refused = needs.refusal(instance, candidate);
  }
  const std::size_t chosen = splatray::choose_device(infos, wanted, started.said);
  physical_device = started.devices[chosen];
  info_ = infos[chosen];
  meets_needs_ = !needs.refusal || needs.refusal(instance, physical_device).empty();
}

void VulkanDevice::create_device(const DeviceNeeds& needs) {
  VkPhysicalDeviceMaintenance3Properties limits{};
  limits.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES;
  VkPhysicalDeviceProperties2 chain{};
  chain.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
  chain.pNext = &limits;
  vkGetPhysicalDeviceProperties2(physical_device, &chain);
  properties = chain.properties;
  vkGetPhysicalDeviceMemoryProperties(physical_device, &memory);
  limits_ = device_limits(properties.limits, limits.maxMemoryAllocationSize);

  queue_family = compute_queue_family(physical_device);
  const std::uint32_t queues =
      needs.second_queue && meets_needs_ ? std::min(queue_count(physical_device, queue_family), 2U) : 1;
  VkResult made = make_device(needs, queues);
  if (needs.optional && meets_needs_ &&
      (made == VK_ERROR_EXTENSION_NOT_PRESENT || made == VK_ERROR_FEATURE_NOT_PRESENT)) {
    meets_needs_ = false;
    made = make_device(needs, queues);
  }
  check(made, "opening the Vulkan device");
  queue.emplace(device, queue_family, 0);
  if (queues > 1) second_.emplace(device, queue_family, 1);
}

/// Makes the device, with what is needed where it has that.
VkResult VulkanDevice::make_device(const DeviceNeeds& needs, std::uint32_t queues) {
  constexpr std::array PRIORITIES = {1.0F, 1.0F};
  VkDeviceQueueCreateInfo queue_info{};
  queue_info.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
  queue_info.queueFamilyIndex = queue_family;
  queue_info.queueCount = queues;
  queue_info.pQueuePriorities = PRIORITIES.data();
  VkPhysicalDeviceTimelineSemaphoreFeatures timelines{};  // all devices of Vulkan 1.2 have them
  timelines.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_TIMELINE_SEMAPHORE_FEATURES;
  timelines.pNext = meets_needs_ ? const_cast<void*>(needs.features) : nullptr;
  timelines.timelineSemaphore = VK_TRUE;
  VkDeviceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
  info.pNext = &timelines;
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queue_info;
  info.enabledExtensionCount = meets_needs_ ? static_cast<std::uint32_t>(needs.device_extensions.size()) : 0;
  info.ppEnabledExtensionNames = needs.device_extensions.data();
  return vkCreateDevice(physical_device, &info, nullptr, &device);
}

void VulkanDevice::destroy() {
  if (device != VK_NULL_HANDLE) vkDestroyDevice(device, nullptr);
  if (messenger_ != VK_NULL_HANDLE) {
    const auto end = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
        vkGetInstanceProcAddr(instance, "vkDestroyDebugUtilsMessengerEXT"));
    end(instance, messenger_, nullptr);
  }
  if (instance != VK_NULL_HANDLE) vkDestroyInstance(instance, nullptr);
}

}  // namespace splatray
