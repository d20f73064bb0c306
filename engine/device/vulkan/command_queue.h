/// Work for the device, one submission behind the other.
#pragma once
#include <array>
#include <chrono>
#include <cstddef>
#include <functional>
#include <span>

#include "engine/device/queue.h"
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

/// A command buffer that is recorded anew for each submission, and what says when the device has done it.
class Submission {
 public:
  /// `pool` has its commands. The device must outlive it.
  Submission(const VulkanDevice& vulkan, VkCommandPool pool);

  /// Hands over what `record` records; what that writes is visible to host and device once it was waited for. Not before
  /// it was waited for again.
  void submit(const SharedQueue& queue, const std::function<void(VkCommandBuffer)>& record);
  /// Waits for it. Returns the milliseconds it took on the device, or on the wall clock where the device has no timestamps.
  double wait();

 private:
  void record(const std::function<void(VkCommandBuffer)>& record);
  [[nodiscard]] double timestamps_ms() const;

  const VulkanDevice& vulkan_;
  VkCommandBuffer commands_;
  Handle<VkFence, vkDestroyFence> fence_;
  Handle<VkQueryPool, vkDestroyQueryPool> timestamps_;  ///< null where the queue has none
  std::uint64_t timestamp_mask_ = 0;
  std::chrono::steady_clock::time_point start_{};
};

/// One thread at a time. The device must outlive it.
class CommandQueue {
 public:
  explicit CommandQueue(const VulkanDevice& vulkan) : CommandQueue(vulkan, *vulkan.queue) {}
  /// Hands its work to another queue than the device's first.
  CommandQueue(const VulkanDevice& vulkan, const SharedQueue& queue);
  /// Waits for what was begun.
  ~CommandQueue();
  CommandQueue(const CommandQueue&) = delete;
  CommandQueue& operator=(const CommandQueue&) = delete;

  /// Runs the commands that `record` records and waits for them, and so for all that was begun; what they wrote is then visible to
  /// host and device. Returns as Submission::wait.
  double run(const std::function<void(VkCommandBuffer)>& record);

  /// Begins what `record` records, behind all that was begun before: fewer than IN_FLIGHT_MOST that were not ended.
  void begin(const std::function<void(VkCommandBuffer)>& record);
  /// Waits for what was begun first and not yet ended, as run() does.
  double end();
  /// Waits for all that was begun, which is still to be ended.
  void finish();

  /// As Queue's.
  void upload(VulkanBuffer& buffer, std::span<const std::byte> bytes, VkDeviceSize begin = 0);
  void download(const VulkanBuffer& buffer, std::span<std::byte> bytes);

  /// A mapped buffer of min(bytes, 64 MiB) or more, valid until the next call.
  [[nodiscard]] const VulkanBuffer& staging(VkDeviceSize bytes);

 private:
  void upload_staged(VulkanBuffer& buffer, std::span<const std::byte> bytes, VkDeviceSize begin);

  const VulkanDevice& vulkan_;
  const SharedQueue& queue_;
  Handle<VkCommandPool, vkDestroyCommandPool> pool_;
  Submission own_;                                    ///< of run()
  std::array<Submission, 2> copies_;                  ///< of upload_staged(), in turn
  std::array<Submission, IN_FLIGHT_MOST> in_flight_;  ///< of begin(), in turn
  std::uint64_t begun_ = 0, waited_ = 0, ended_ = 0;  ///< since construction; ended_ <= waited_ <= begun_
  std::array<double, IN_FLIGHT_MOST> ms_{};           ///< of those waited for and not ended
  VulkanBuffer staging_;
};

}  // namespace splatray
