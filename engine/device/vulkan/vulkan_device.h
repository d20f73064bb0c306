/// Instance, device and queue; headless unless given what a window needs. No extension is required; Vulkan 1.2.
/// Or, without Vulkan, the host itself.
#pragma once
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "engine/device/vulkan/functions.h"

namespace splatray {

/// A physical device and what we think of it.
struct DeviceInfo {
  std::string name;
  std::string type;     ///< "discrete GPU", "integrated GPU", "virtual GPU", "CPU", "other"
  std::string driver;   ///< name and version string of the driver
  std::string api;      ///< "1.3.230"
  std::string refused;  ///< why it cannot be used; empty = usable
};

/// What a program that presents in a window needs of Vulkan; nothing for a headless one.
struct WindowNeeds {
  std::vector<const char*> instance_extensions;
  std::vector<const char*> device_extensions;
  /// Why the device's compute queue will not do; empty = it will.
  std::function<std::string(VkInstance, VkPhysicalDevice)> refusal;
};

/// What a user asks for who wants no Vulkan device but the host's CPU (engine/cpu).
inline constexpr const char* HOST_DEVICE = "cpu";

class Context {
 public:
  /// `wanted`: "" = the best (discrete > integrated > virtual > other > CPU), a number of list_devices, or
  /// part of a name (case-insensitive); HOST_DEVICE = no Vulkan, which is then not even loaded. Throws
  /// Error (no_device) with every device's reason when none fits.
  /// Validation layers and their messages are on when `validation` (or the environment variable
  /// SPLATRAY_VALIDATION=1) is set; each validation warning or error is counted and printed on stderr. Throws
  /// Error (failed) when they are asked for but not installed.
  explicit Context(const std::string& wanted = "", bool validation = false, const WindowNeeds& needs = {});
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  [[nodiscard]] const DeviceInfo& device_info() const { return info_; }
  /// So far; from any thread.
  [[nodiscard]] std::uint32_t validation_messages() const { return validation_messages_; }
  /// Whether the device is a software driver on the CPU.
  [[nodiscard]] bool is_cpu() const { return properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU; }

  /// Whether it is the host itself: buffers are host memory, programs C++, and there are no Vulkan objects.
  [[nodiscard]] bool is_host() const { return device == VK_NULL_HANDLE; }

  VkInstance instance = VK_NULL_HANDLE;
  VkPhysicalDevice physical_device = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  std::uint32_t queue_family = 0;
  VkQueue queue = VK_NULL_HANDLE;
  VkCommandPool command_pool = VK_NULL_HANDLE;
  VkPhysicalDeviceProperties properties{};
  VkPhysicalDeviceMemoryProperties memory{};
  std::uint64_t max_allocation_bytes = 0;  ///< largest single allocation the device promises
  bool float64 = false;                    ///< shaders may use float64
  bool ballot = false;                     ///< compute shaders may use ballots of their subgroups

 private:
  void become_host();
  void create_instance(bool validation, const WindowNeeds& needs);
  void create_messenger();
  void choose_device(const std::string& wanted, const WindowNeeds& needs);
  void create_device(const WindowNeeds& needs);
  void destroy();

  DeviceInfo info_;
  std::atomic<std::uint32_t> validation_messages_{0};  ///< counted on whatever thread calls Vulkan
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
};

/// The host as a device.
[[nodiscard]] DeviceInfo host_device_info();

/// All Vulkan devices, usable or not, in the order of their numbers. Empty when there is no Vulkan loader's driver
/// at all.
[[nodiscard]] std::vector<DeviceInfo> list_devices();

/// The number of the device a user who asked for `wanted` gets (Context::Context says how); throws Error
/// (no_device).
[[nodiscard]] std::size_t choose_device(const std::vector<DeviceInfo>& devices, const std::string& wanted);

/// What is known of a physical device, and why it cannot be used.
[[nodiscard]] DeviceInfo describe_device(VkPhysicalDevice device);

/// The number of the first queue family that computes, or UINT32_MAX.
[[nodiscard]] std::uint32_t compute_queue_family(VkPhysicalDevice device);

/// All physical devices of an instance.
[[nodiscard]] std::vector<VkPhysicalDevice> physical_devices(VkInstance instance);

/// Throws Error (failed, or out_of_memory for the two memory results) naming `what` unless the result is
/// VK_SUCCESS.
void check(VkResult result, const char* what);

}  // namespace splatray
