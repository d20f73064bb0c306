/// The devices of a viewer: what traces, and what shows.
#pragma once
#include <memory>
#include <string>

#include "app/view/window/window.h"
#include "engine/device/device.h"
#include "engine/device/vulkan/vulkan_device.h"

namespace splatray {

/// One device for both where what traces is Vulkan's and can show pictures in the window.
class ViewDevices {
 public:
  /// `wanted`, what traces: as open_device has it. The window must outlive it. Throws Error (no_device) where there is none, or none
  /// that can show pictures.
  ViewDevices(const std::string& wanted, const Window& window);

  [[nodiscard]] const Device& tracing() const { return *tracing_; }
  [[nodiscard]] const VulkanDevice& showing() const { return *showing_; }
  /// What shows, where that is what traces; else null.
  [[nodiscard]] const VulkanDevice* shared() const { return own_ ? nullptr : showing_; }
  /// Messages of Vulkan's validation layers so far.
  [[nodiscard]] std::uint32_t validation_messages() const;

 private:
  std::unique_ptr<Device> tracing_;
  std::unique_ptr<VulkanDevice> own_;      ///< null: what traces shows
  const VulkanDevice* showing_ = nullptr;  ///< either
};

}  // namespace splatray
