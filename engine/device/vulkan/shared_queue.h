/// A queue of a Vulkan device that several threads hand work to.
#pragma once
#include <mutex>

#include "engine/device/vulkan/functions.h"

namespace splatray {

/// All members may be called from any thread, one after the other; results are those of Vulkan's functions.
class SharedQueue {
 public:
  /// That of a number below the family's count, made with the device.
  SharedQueue(VkDevice device, std::uint32_t family, std::uint32_t number) {
    vkGetDeviceQueue(device, family, number, &queue_);
  }

  /// `fence`: signalled when the work is done; or null.
  [[nodiscard]] VkResult submit(const VkSubmitInfo& work, VkFence fence) const {
    const std::lock_guard lock(mutex_);
    return vkQueueSubmit(queue_, 1, &work, fence);
  }
  [[nodiscard]] VkResult present(const VkPresentInfoKHR& pictures) const {
    const std::lock_guard lock(mutex_);
    return vkQueuePresentKHR(queue_, &pictures);
  }
  /// Waits until all that was handed over is done.
  VkResult wait() const {
    const std::lock_guard lock(mutex_);
    return vkQueueWaitIdle(queue_);
  }
  /// For who hands it nothing.
  [[nodiscard]] VkQueue get() const { return queue_; }

 private:
  VkQueue queue_ = VK_NULL_HANDLE;
  mutable std::mutex mutex_;
};

}  // namespace splatray
