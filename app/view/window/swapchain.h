/// The pictures that a window shows in turn.
#pragma once
#include <glm/glm.hpp>
#include <vector>

#include "engine/device/vulkan/handle.h"
#include "engine/device/vulkan/vulkan_device.h"

namespace splatray {

/// Owner of a window's surface. The instance must outlive it.
class WindowSurface {
 public:
  WindowSurface(VkInstance instance, VkSurfaceKHR surface) : instance_(instance), surface_(surface) {}
  ~WindowSurface() { vkDestroySurfaceKHR(instance_, surface_, nullptr); }
  WindowSurface(const WindowSurface&) = delete;
  WindowSurface& operator=(const WindowSurface&) = delete;

  [[nodiscard]] VkSurfaceKHR get() const { return surface_; }

 private:
  VkInstance instance_;
  VkSurfaceKHR surface_;
};

/// A format of 8 bits a channel that stores display values as they are. Throws Error (no_device) when the surface has
/// none.
[[nodiscard]] VkSurfaceFormatKHR choose_surface_format(const VulkanDevice& vulkan, VkSurfaceKHR surface);

/// A pass that draws over what a swapchain's picture holds (in TRANSFER_DST_OPTIMAL) and leaves it ready to be shown.
[[nodiscard]] Handle<VkRenderPass, vkDestroyRenderPass> make_overlay_pass(const VulkanDevice& vulkan,
                                                                          VkFormat format);

/// A swapchain of one size, in the order of FIFO, with a framebuffer for each of its pictures.
struct Swapchain {
  struct Picture {
    VkImage image = VK_NULL_HANDLE;
    Handle<VkImageView, vkDestroyImageView> view;
    Handle<VkFramebuffer, vkDestroyFramebuffer> framebuffer;
    Handle<VkSemaphore, vkDestroySemaphore> drawn;  ///< what presenting waits for
  };

  Swapchain() = default;
  /// `size` in pixels is taken where the surface has no size of its own. `old`, which may be null, gives up its
  /// pictures. An area of zero makes none: pictures is empty.
  Swapchain(const VulkanDevice& vulkan, VkSurfaceKHR surface, VkSurfaceFormatKHR format, VkRenderPass pass,
            glm::uvec2 size, VkSwapchainKHR old);

  Handle<VkSwapchainKHR, vkDestroySwapchainKHR> handle;
  VkExtent2D extent{};  ///< pixels
  std::vector<Picture> pictures;

 private:
  void make_pictures(const VulkanDevice& vulkan, VkFormat format, VkRenderPass pass);
};

/// A binary semaphore.
[[nodiscard]] Handle<VkSemaphore, vkDestroySemaphore> make_semaphore(const VulkanDevice& vulkan);

}  // namespace splatray
