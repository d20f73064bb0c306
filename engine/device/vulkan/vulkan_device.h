/// A Vulkan device: instance, device and queues; headless unless given what a window needs. No extension is required; Vulkan 1.2.
#pragma once
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/device/device.h"
#include "engine/device/vulkan/functions.h"
#include "engine/device/vulkan/instance.h"
#include "engine/device/vulkan/shared_queue.h"

namespace splatray {

/// What a program needs of Vulkan beside what the engine does: to present in a window, say.
struct DeviceNeeds {
  std::vector<const char*> instance_extensions;
  std::vector<const char*> device_extensions;
  /// Why the device's compute queue will not do; empty = it will.
  std::function<std::string(VkInstance, VkPhysicalDevice)> refusal;
  const void* features = nullptr;  ///< of device_extensions, as VkDeviceCreateInfo::pNext has them
  bool optional = false;      ///< a device that has not got it is opened without: VulkanDevice::meets_needs
  bool second_queue = false;  ///< VulkanDevice::second_queue is one of its own where the device has two
};

class VulkanDevice final : public Device {
 public:
  /// `wanted`: as open_device has it, but for HOST_DEVICE.
  /// Validation layers and their messages are on when `validation` (or the environment variable
  /// SPLATRAY_VALIDATION=1) is set; each validation warning or error is counted and printed on stderr. Throws
  /// Error (failed) when they are asked for but not installed.
  explicit VulkanDevice(const std::string& wanted = "", bool validation = false,
                        const DeviceNeeds& needs = {});
  ~VulkanDevice() override;

  [[nodiscard]] const DeviceInfo& info() const override { return info_; }
  [[nodiscard]] const DeviceLimits& limits() const override { return limits_; }
  [[nodiscard]] DeviceProfile profile() const override;
  [[nodiscard]] std::unique_ptr<Queue> make_queue(const QueueOptions& options = {}) const override;
  [[nodiscard]] std::uint32_t validation_messages() const override { return validation_messages_; }
  /// Whether it has what it was asked to have; always where that was not optional.
  [[nodiscard]] bool meets_needs() const { return meets_needs_; }
  /// For another thread's work than that of `queue`; the same where the device has but one.
  [[nodiscard]] const SharedQueue& second_queue() const { return second_ ? *second_ : *queue; }
  /// Whether the device is a software driver on the CPU.
  [[nodiscard]] bool is_cpu() const { return properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU; }

  VkInstance instance = VK_NULL_HANDLE;
  VkPhysicalDevice physical_device = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  std::uint32_t queue_family = 0;
  std::optional<SharedQueue> queue;
  VkPhysicalDeviceProperties properties{};
  VkPhysicalDeviceMemoryProperties memory{};

 private:
  VulkanStart start(bool validation, const DeviceNeeds& needs);
  void create_messenger();
  void choose_device(const VulkanStart& started, const std::string& wanted, const DeviceNeeds& needs);
  void create_device(const DeviceNeeds& needs);
  [[nodiscard]] VkResult make_device(const DeviceNeeds& needs, std::uint32_t queues);
  void destroy();

  DeviceInfo info_;
  DeviceLimits limits_;
  bool meets_needs_ = true;
  std::optional<SharedQueue> second_;
  std::atomic<std::uint32_t> validation_messages_{0};  ///< counted on whatever thread calls Vulkan
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
};

/// As list_devices().
[[nodiscard]] std::vector<DeviceInfo> vulkan_devices();

/// The number of the device a user who asked for `wanted` gets (open_device says how); throws Error
/// (no_device), with what was said where there are no devices (VulkanStart::said).
[[nodiscard]] std::size_t choose_device(const std::vector<DeviceInfo>& devices, const std::string& wanted,
                                        const std::string& said = "");

/// What is known of a physical device, and why it cannot be used.
[[nodiscard]] DeviceInfo describe_device(VkPhysicalDevice device);

/// The number of the first queue family that computes, or UINT32_MAX.
[[nodiscard]] std::uint32_t compute_queue_family(VkPhysicalDevice device);

/// Throws Error (failed, or out_of_memory for the two memory results) naming `what` unless the result is
/// VK_SUCCESS.
void check(VkResult result, const char* what);

}  // namespace splatray
