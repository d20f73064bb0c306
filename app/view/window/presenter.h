/// Brings the newest picture, and the controls over it, into the window.
#pragma once
#include <optional>
#include <span>

#include "app/view/window/gui.h"
#include "app/view/window/swapchain.h"
#include "app/view/window/window.h"
#include "engine/device/vulkan/buffer.h"
#include "engine/device/vulkan/command_queue.h"
#include "engine/device/vulkan/vulkan_device.h"

namespace splatray {

/// On the window's thread, with a Vulkan device of its own; the window must outlive it. Vulkan's messages are as in
/// VulkanDevice.
class Presenter {
 public:
  /// Throws Error (no_device) when no device can show pictures in the window.
  explicit Presenter(Window& window);
  ~Presenter();
  Presenter(const Presenter&) = delete;
  Presenter& operator=(const Presenter&) = delete;

  /// The picture to be shown from now on: `width` x `height` pixels of sRGB 8 bit rgba, r first, top row first.
  void set_picture(std::span<const std::uint8_t> rgba, std::uint32_t width, std::uint32_t height);
  /// Shows the picture, fitted into the window's left `picture_width` pixels, and the controls that Gui::end() ended.
  /// Nothing while minimised; survives a changed window and a lost surface.
  void draw(std::uint32_t picture_width);

  [[nodiscard]] Gui& gui() { return *gui_; }
  [[nodiscard]] const Gui& gui() const { return *gui_; }
  [[nodiscard]] std::uint32_t validation_messages() const { return vulkan_.validation_messages(); }

 private:
  [[nodiscard]] std::optional<std::uint32_t> acquire();
  void record(const Swapchain::Picture& target, std::uint32_t picture_width);
  void record_picture(VkImage target, std::uint32_t picture_width);
  void submit_and_present(std::uint32_t index);
  void renew_swapchain();
  void wait_until_drawn();

  Window& window_;
  VulkanDevice vulkan_;
  CommandQueue queue_;
  std::optional<WindowSurface> surface_;
  VkSurfaceFormatKHR format_{};
  Handle<VkRenderPass, vkDestroyRenderPass> pass_;
  Swapchain swapchain_;
  glm::uvec2 swapchain_size_{0};  ///< of the framebuffer when it was made; 0 x 0: to be made anew
  Handle<VkSemaphore, vkDestroySemaphore> acquired_;
  Handle<VkFence, vkDestroyFence> drawn_;  ///< signalled: the last frame's commands are done
  VkCommandBuffer commands_ = VK_NULL_HANDLE;
  std::optional<Gui> gui_;

  VulkanBuffer pixels_;  ///< of the picture, on their way to it
  Memory memory_;
  Handle<VkImage, vkDestroyImage> picture_;
  VkExtent2D size_{};    ///< of the picture
  bool copied_ = false;  ///< picture_ holds pixels_
};

}  // namespace splatray
