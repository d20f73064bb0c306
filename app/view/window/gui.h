/// Dear ImGui in the viewer's window: its GLFW and Vulkan back ends.
#pragma once
#include <cstdint>
#include <functional>

#include "app/view/window/window.h"
#include "engine/device/vulkan/command_queue.h"
#include "engine/device/vulkan/vulkan_device.h"

struct ImDrawData;

namespace splatray {

/// One at a time, on the window's thread. Window, device, queue and pass must outlive it.
class Gui {
 public:
  /// Pictures that it may draw before the device has drawn the first of them.
  static constexpr std::uint32_t FRAMES = 2;

  /// Draws in `pass`; `finish` waits for all that it has drawn.
  Gui(Window& window, const VulkanDevice& vulkan, CommandQueue& queue, VkRenderPass pass,
      std::function<void()> finish);
  ~Gui();
  Gui(const Gui&) = delete;
  Gui& operator=(const Gui&) = delete;

  /// Starts a frame of controls, of another size when the display's scale has changed.
  void begin();
  /// Ends it: what record() draws next.
  void end();
  void record(VkCommandBuffer commands);

  [[nodiscard]] float scale() const { return scale_; }
  /// Size of the font, pixels of the framebuffer.
  [[nodiscard]] double em_px() const;
  /// Whether a control is held or written into.
  [[nodiscard]] bool is_editing() const;
  /// Whether the mouse is over, or the keyboard writes into, a control.
  [[nodiscard]] bool wants_mouse() const;
  [[nodiscard]] bool wants_keyboard() const;

 private:
  void start_renderer();

  Window& window_;
  const VulkanDevice& vulkan_;
  CommandQueue& queue_;
  VkRenderPass pass_;
  std::function<void()> finish_;
  Handle<VkDescriptorPool, vkDestroyDescriptorPool> descriptors_;
  float scale_ = 1.0F;
};

}  // namespace splatray
