/// Brings the newest picture, and the controls over it, into the window.
#pragma once
#include <array>
#include <optional>
#include <span>

#include "app/view/display/device_picture.h"
#include "app/view/window/gui.h"
#include "app/view/window/swapchain.h"
#include "app/view/window/window.h"
#include "engine/device/vulkan/buffer.h"
#include "engine/device/vulkan/command_queue.h"
#include "engine/device/vulkan/vulkan_device.h"

namespace splatray {

/// On the window's thread; the window and the device, which was opened for it, must outlive it. Up to Gui::FRAMES frames are under way
/// on the device at a time.
class Presenter {
 public:
  /// Throws Error (no_device) when the device cannot show pictures in the window.
  Presenter(Window& window, const VulkanDevice& vulkan);
  ~Presenter();
  Presenter(const Presenter&) = delete;
  Presenter& operator=(const Presenter&) = delete;

  /// The picture to be shown from now on: `width` x `height` pixels of sRGB 8 bit rgba, r first, top row first.
  void set_picture(std::span<const std::uint8_t> rgba, std::uint32_t width, std::uint32_t height);
  /// The same of one that is on the device, or will be.
  void set_picture(SharedPicture picture, std::uint32_t width, std::uint32_t height);
  /// Shows the picture, fitted into the window's left `picture_width` pixels, and the controls that Gui::end() ended.
  /// Nothing while minimised; survives a changed window and a lost surface.
  void draw(std::uint32_t picture_width);

  [[nodiscard]] Gui& gui() { return *gui_; }
  [[nodiscard]] const Gui& gui() const { return *gui_; }

 private:
  /// One on its way into the window.
  struct Frame {
    VkCommandBuffer commands = VK_NULL_HANDLE;
    Handle<VkSemaphore, vkDestroySemaphore> acquired;
    Handle<VkFence, vkDestroyFence> drawn;  ///< signalled: its commands are done
    SharedPicture source;                   ///< what they copy; null: nothing
  };

  [[nodiscard]] std::optional<std::uint32_t> acquire(const Frame& frame);
  void record(Frame& frame, const Swapchain::Picture& target, std::uint32_t picture_width);
  void record_picture(Frame& frame, VkImage target, std::uint32_t picture_width);
  void submit(const Frame& frame, VkSemaphore drawn);
  void present(std::uint32_t index);
  void renew_swapchain();
  void wait_until_drawn(Frame& frame);
  void finish();

  Window& window_;
  const VulkanDevice& vulkan_;
  CommandQueue queue_;
  std::optional<WindowSurface> surface_;
  VkSurfaceFormatKHR format_{};
  Handle<VkRenderPass, vkDestroyRenderPass> pass_;
  Swapchain swapchain_;
  glm::uvec2 swapchain_size_{0};  ///< of the framebuffer when it was made; 0 x 0: to be made anew
  Handle<VkCommandPool, vkDestroyCommandPool> pool_;
  std::array<Frame, Gui::FRAMES> frames_;
  std::size_t next_ = 0;  ///< of frames_
  std::optional<Gui> gui_;

  PictureRing of_host_;   ///< pictures on their way from the host
  SharedPicture source_;  ///< the picture, until image_ holds it; null: it does
  Memory memory_;
  Handle<VkImage, vkDestroyImage> image_;
  VkExtent2D size_{};  ///< of the picture
};

}  // namespace splatray
