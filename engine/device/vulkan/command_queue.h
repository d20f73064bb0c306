/// Work for the device, one submission at a time.
#pragma once
#include <functional>

#include "engine/device/vulkan/buffer.h"
#include "engine/device/vulkan/handle.h"
#include "engine/device/vulkan/vulkan_device.h"

namespace splatray {

/// Lets everything recorded after it see the memory written by everything recorded before it.
void record_barrier(VkCommandBuffer commands);

/// Likewise for a colour image of one level and layer, and moves it from one layout to another.
void record_layout(VkCommandBuffer commands, VkImage image, VkImageLayout from, VkImageLayout to);

/// Records, submits and waits. One thread at a time. The context must outlive it; one of the host has no commands to run.
class CommandQueue {
 public:
  explicit CommandQueue(const Context& context);
  ~CommandQueue();
  CommandQueue(const CommandQueue&) = delete;
  CommandQueue& operator=(const CommandQueue&) = delete;

  /// Runs the commands that `record` records and waits for them; what they wrote is then visible to host and
  /// device. Returns the milliseconds they took on the device, or on the wall clock where the device has no
  /// timestamps.
  double run(const std::function<void(VkCommandBuffer)>& record);

  /// A mapped buffer of min(bytes, 64 MiB) or more, valid until the next call.
  [[nodiscard]] const Buffer& staging(VkDeviceSize bytes);

 private:
  void submit_and_wait();
  [[nodiscard]] double timestamps_ms() const;

  const Context& context_;
  Handle<VkFence, vkDestroyFence> fence_;
  Handle<VkQueryPool, vkDestroyQueryPool> timestamps_;  ///< null where the queue has none
  std::uint64_t timestamp_mask_ = 0;
  VkCommandBuffer commands_ = VK_NULL_HANDLE;
  Buffer staging_;
};

}  // namespace splatray
