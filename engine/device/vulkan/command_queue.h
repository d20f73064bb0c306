/// Work for the device, one submission at a time.
#pragma once
#include <cstddef>
#include <functional>
#include <span>

#include "engine/device/vulkan/buffer.h"
#include "engine/device/vulkan/handle.h"
#include "engine/device/vulkan/vulkan_device.h"

namespace splatray {

/// Lets everything recorded after it see the memory written by everything recorded before it.
void record_barrier(VkCommandBuffer commands);

/// Likewise for a colour image of one level and layer, and moves it from one layout to another.
void record_layout(VkCommandBuffer commands, VkImage image, VkImageLayout from, VkImageLayout to);

/// A pool of command buffers that are recorded anew, for one thread at a time.
[[nodiscard]] Handle<VkCommandPool, vkDestroyCommandPool> make_command_pool(const VulkanDevice& vulkan);

/// A command buffer of a pool, which frees it.
[[nodiscard]] VkCommandBuffer make_commands(const VulkanDevice& vulkan, VkCommandPool pool);

/// Begins to record what is submitted once.
void begin_commands(VkCommandBuffer commands);

/// Records, submits and waits. One thread at a time. The device must outlive it.
class CommandQueue {
 public:
  explicit CommandQueue(const VulkanDevice& vulkan) : CommandQueue(vulkan, *vulkan.queue) {}
  /// Hands its work to another queue than the device's first.
  CommandQueue(const VulkanDevice& vulkan, const SharedQueue& queue);
  CommandQueue(const CommandQueue&) = delete;
  CommandQueue& operator=(const CommandQueue&) = delete;

  /// Runs the commands that `record` records and waits for them; what they wrote is then visible to host and
  /// device. Returns the milliseconds they took on the device, or on the wall clock where the device has no
  /// timestamps.
  double run(const std::function<void(VkCommandBuffer)>& record);

  /// As Queue's.
  void upload(VulkanBuffer& buffer, std::span<const std::byte> bytes, VkDeviceSize begin = 0);
  void download(const VulkanBuffer& buffer, std::span<std::byte> bytes);

  /// A mapped buffer of min(bytes, 64 MiB) or more, valid until the next call.
  [[nodiscard]] const VulkanBuffer& staging(VkDeviceSize bytes);

 private:
  void submit_and_wait();
  [[nodiscard]] double timestamps_ms() const;

  const VulkanDevice& vulkan_;
  const SharedQueue& queue_;
  Handle<VkCommandPool, vkDestroyCommandPool> pool_;
  Handle<VkFence, vkDestroyFence> fence_;
  Handle<VkQueryPool, vkDestroyQueryPool> timestamps_;  ///< null where the queue has none
  std::uint64_t timestamp_mask_ = 0;
  VkCommandBuffer commands_ = VK_NULL_HANDLE;
  VulkanBuffer staging_;
};

}  // namespace splatray
