/// Pictures as a screen takes them, on a device that draws windows.
#pragma once
#include <atomic>
#include <memory>
#include <vector>

#include "engine/device/vulkan/buffer.h"
#include "engine/device/vulkan/handle.h"

namespace splatray {

using TimelineSemaphore = Handle<VkSemaphore, vkDestroySemaphore>;

/// A picture on a device. Threads share it; it is written by who took it from its ring, before it is handed on.
struct DevicePicture {
  VulkanBuffer pixels;                              ///< sRGB 8 bit rgba, r first, row by row from the top
  std::shared_ptr<const TimelineSemaphore> made{};  ///< null: they are there
  std::uint64_t made_at = 0;                        ///< its value when the device has made them
};
using SharedPicture = std::shared_ptr<const DevicePicture>;

/// Keeps the memory of pictures that nobody shows any more for those to come. For one thread; the device must outlive it and all
/// pictures.
class PictureRing {
 public:
  /// Pictures for this use (VK_BUFFER_USAGE_*), beside transfers.
  PictureRing(const VulkanDevice& vulkan, VkBufferUsageFlags usage, Residence residence)
      : vulkan_(vulkan), usage_(usage), residence_(residence) {}

  /// One with room for `bytes` that nobody else holds. Throws Error (out_of_memory).
  [[nodiscard]] std::shared_ptr<DevicePicture> take(std::uint64_t bytes);

 private:
  struct Place {
    DevicePicture picture;
    std::atomic<bool> taken = false;
  };

  const VulkanDevice& vulkan_;
  const VkBufferUsageFlags usage_;
  const Residence residence_;
  std::vector<std::shared_ptr<Place>> places_;
};

}  // namespace splatray
