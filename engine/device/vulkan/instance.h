/// How Vulkan is started: an instance and what devices it has.
#pragma once
#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include "engine/device/vulkan/functions.h"

namespace splatray {

/// A start of Vulkan. Whoever asked for it destroys the instance.
struct VulkanStart {
  VkInstance instance = VK_NULL_HANDLE;  ///< null where no driver starts
  std::vector<VkPhysicalDevice> devices;
  /// Without devices: the result and the loader's words; empty where no driver is installed.
  std::string said;
};

using Pause = std::function<void(std::chrono::milliseconds)>;

/// Waits so long.
void sleep_for(std::chrono::milliseconds time);

/// Makes an instance with these extensions, with the validation layer where `validation` is set. A driver may be installed and
/// not start because others hold what it needs (memory to load its libraries, the hardware): without a device the start is
/// tried again up to five times within half a second. Drivers once started stay loaded. Throws Error as check() does.
[[nodiscard]] VulkanStart start_vulkan(const VkDebugUtilsMessengerCreateInfoEXT* validation = nullptr,
                                       const std::vector<const char*>& extensions = {},
                                       const Pause& pause = sleep_for);

/// The name of the validation layer, and whether it is installed.
inline constexpr const char* VALIDATION_LAYER = "VK_LAYER_KHRONOS_validation";
[[nodiscard]] bool validation_layer_present();

}  // namespace splatray
