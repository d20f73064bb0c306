#include "engine/device/vulkan/command_queue.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cstring>
#include <vector>

#include "engine/base/all_cores.h"

namespace splatray {
namespace {

constexpr VkDeviceSize STAGING_BYTES = VkDeviceSize{64} << 20U;

std::uint32_t timestamp_bits(const VulkanDevice& vulkan) {
  std::uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(vulkan.physical_device, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(vulkan.physical_device, &count, families.data());
  return families[vulkan.queue_family].timestampValidBits;
}

}  // namespace

void record_barrier(VkCommandBuffer commands) {
  VkMemoryBarrier barrier{};
  barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
  barrier.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
  barrier.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT | VK_ACCESS_HOST_READ_BIT;
  vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                       VK_PIPELINE_STAGE_ALL_COMMANDS_BIT | VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &barrier, 0,
                       nullptr, 0, nullptr);
}

void record_layout(VkCommandBuffer commands, VkImage image, VkImageLayout from, VkImageLayout to) {
  VkImageMemoryBarrier barrier{};
  barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER;
  barrier.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
  barrier.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
  barrier.oldLayout = from;
  barrier.newLayout = to;
  barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.image = image;
  barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
  vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 0,
                       nullptr, 0, nullptr, 1, &barrier);
}

Handle<VkCommandPool, vkDestroyCommandPool> make_command_pool(const VulkanDevice& vulkan) {
  VkCommandPoolCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
  info.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
  info.queueFamilyIndex = vulkan.queue_family;
  VkCommandPool pool = VK_NULL_HANDLE;
  check(vkCreateCommandPool(vulkan.device, &info, nullptr, &pool), "making a command pool");
  return {vulkan.device, pool};
}

VkCommandBuffer make_commands(const VulkanDevice& vulkan, VkCommandPool pool) {
  VkCommandBufferAllocateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
  info.commandPool = pool;
  info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
  info.commandBufferCount = 1;
  VkCommandBuffer commands = VK_NULL_HANDLE;
  check(vkAllocateCommandBuffers(vulkan.device, &info, &commands), "making a command buffer");
  return commands;
}

void begin_commands(VkCommandBuffer commands) {
  VkCommandBufferBeginInfo begin{};
  begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
  begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  check(vkBeginCommandBuffer(commands, &begin), "recording commands");
}

Submission::Submission(const VulkanDevice& vulkan, VkCommandPool pool)
    : vulkan_(vulkan), commands_(make_commands(vulkan, pool)) {
  VkFenceCreateInfo fence_info{};
  fence_info.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
  VkFence fence = VK_NULL_HANDLE;
  check(vkCreateFence(vulkan.device, &fence_info, nullptr, &fence), "making a fence");
  fence_ = {vulkan.device, fence};

  if (const std::uint32_t bits = timestamp_bits(vulkan); bits > 0) {
    timestamp_mask_ = bits >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1;
    VkQueryPoolCreateInfo query_info{};
    query_info.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
    query_info.queryType = VK_QUERY_TYPE_TIMESTAMP;
    query_info.queryCount = 2;
    VkQueryPool queries = VK_NULL_HANDLE;
    check(vkCreateQueryPool(vulkan.device, &query_info, nullptr, &queries), "making a query pool");
    timestamps_ = {vulkan.device, queries};
  }
}

void Submission::record(const std::function<void(VkCommandBuffer)>& record) {
  begin_commands(commands_);
  const VkQueryPool queries = timestamps_.get();
  if (queries != VK_NULL_HANDLE) {
    vkCmdResetQueryPool(commands_, queries, 0, 2);
    // Once all that was handed over before is done.
    vkCmdWriteTimestamp(commands_, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, queries, 0);
  }
  try {
    record(commands_);
  } catch (...) {
    vkResetCommandBuffer(commands_,
                         0);  // else it stays in the recording state, in which the next run may not begin
    throw;
  }
  record_barrier(commands_);
  if (queries != VK_NULL_HANDLE)
    vkCmdWriteTimestamp(commands_, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, queries, 1);
  check(vkEndCommandBuffer(commands_), "recording commands");
}

void Submission::submit(const SharedQueue& queue, const std::function<void(VkCommandBuffer)>& record) {
  this->record(record);
  start_ = std::chrono::steady_clock::now();
  VkSubmitInfo submit{};
  submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
  submit.commandBufferCount = 1;
  submit.pCommandBuffers = &commands_;
  check(queue.submit(submit, fence_.get()), "submitting work to the device");
}

double Submission::wait() {
  VkFence fence = fence_.get();
  check(vkWaitForFences(vulkan_.device, 1, &fence, VK_TRUE, UINT64_MAX), "waiting for the device");
  check(vkResetFences(vulkan_.device, 1, &fence), "resetting a fence");
  const std::chrono::duration<double, std::milli> wall = std::chrono::steady_clock::now() - start_;
  return timestamps_.get() != VK_NULL_HANDLE ? timestamps_ms() : wall.count();
}

double Submission::timestamps_ms() const {
  std::uint64_t ticks[2] = {};
  check(vkGetQueryPoolResults(vulkan_.device, timestamps_.get(), 0, 2, sizeof(ticks), ticks, sizeof(ticks[0]),
                              VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
        "reading timestamps");
  const auto passed = static_cast<double>((ticks[1] - ticks[0]) & timestamp_mask_);
  return passed * static_cast<double>(vulkan_.properties.limits.timestampPeriod) * 1e-6;
}

CommandQueue::CommandQueue(const VulkanDevice& vulkan, const SharedQueue& queue)
    : vulkan_(vulkan),
      queue_(queue),
      pool_(make_command_pool(vulkan)),
      own_(vulkan, pool_.get()),
      copies_{Submission(vulkan, pool_.get()), Submission(vulkan, pool_.get())},
      in_flight_{Submission(vulkan, pool_.get()), Submission(vulkan, pool_.get())} {
  static_assert(IN_FLIGHT_MOST == 2);
}

CommandQueue::~CommandQueue() {
  try {
    finish();
  } catch (const std::exception&) {
    // The device was lost: nothing of it is waited for.
  }
}

double CommandQueue::run(const std::function<void(VkCommandBuffer)>& record) {
  own_.submit(queue_, record);
  return own_.wait();
}

void CommandQueue::begin(const std::function<void(VkCommandBuffer)>& record) {
  assert(begun_ - ended_ < IN_FLIGHT_MOST);
  in_flight_[begun_ % IN_FLIGHT_MOST].submit(queue_, record);
  ++begun_;
}

double CommandQueue::end() {
  assert(ended_ < begun_);
  const std::size_t place = ended_ % IN_FLIGHT_MOST;
  if (waited_ == ended_) {
    ++waited_;
    ms_[place] = in_flight_[place].wait();
  }
  ++ended_;
  return ms_[place];
}

void CommandQueue::finish() {
  while (waited_ < begun_) {
    const std::size_t place = waited_++ % IN_FLIGHT_MOST;
    ms_[place] = in_flight_[place].wait();
  }
}

void CommandQueue::upload(VulkanBuffer& buffer, std::span<const std::byte> bytes, VkDeviceSize begin) {
  assert(begin + bytes.size() <= buffer.size());
  if (bytes.empty()) return;
  finish();
  if (buffer.mapped() != nullptr)
    copy_on_all_cores(bytes, buffer.mapped() + begin);
  else
    upload_staged(buffer, bytes, begin);
}

/// By turns through two halves of the staging buffer: the device copies one while the host, who may have to read a file for it, fills
/// the other.
void CommandQueue::upload_staged(VulkanBuffer& buffer, std::span<const std::byte> bytes, VkDeviceSize begin) {
  constexpr std::size_t PIECE = STAGING_BYTES / 2;
  const VulkanBuffer& passed = staging(bytes.size());
  const std::size_t pieces = (bytes.size() + PIECE - 1) / PIECE;
  for (std::size_t i = 0; i < pieces; ++i) {
    const std::size_t half = i % 2, from = i * PIECE, at = half * PIECE;
    const std::span<const std::byte> piece = bytes.subspan(from, std::min(PIECE, bytes.size() - from));
    if (i >= 2) copies_[half].wait();
    copy_on_all_cores(piece, passed.mapped() + at);
    copies_[half].submit(queue_, [&](VkCommandBuffer commands) {
      const VkBufferCopy region{at, begin + from, piece.size()};
      vkCmdCopyBuffer(commands, passed.get(), buffer.get(), 1, &region);
    });
  }
  for (std::size_t i = pieces - std::min<std::size_t>(pieces, 2); i < pieces; ++i) copies_[i % 2].wait();
}

void CommandQueue::download(const VulkanBuffer& buffer, std::span<std::byte> bytes) {
  assert(bytes.size() <= buffer.size());
  if (bytes.empty()) return;
  finish();
  if (buffer.mapped() != nullptr) {
    std::memcpy(bytes.data(), buffer.mapped(), bytes.size());
    return;
  }
  const VulkanBuffer& passed = staging(bytes.size());
  for (std::size_t at = 0; at < bytes.size(); at += passed.size()) {
    const std::size_t count = std::min<std::size_t>(passed.size(), bytes.size() - at);
    run([&](VkCommandBuffer commands) {
      const VkBufferCopy region{at, 0, count};
      vkCmdCopyBuffer(commands, buffer.get(), passed.get(), 1, &region);
    });
    std::memcpy(bytes.data() + at, passed.mapped(), count);
  }
}

const VulkanBuffer& CommandQueue::staging(VkDeviceSize bytes) {
  const VkDeviceSize wanted = std::min(bytes, STAGING_BYTES);
  if (staging_.size() < wanted) staging_ = VulkanBuffer(vulkan_, wanted, 0, Residence::host);
  return staging_;
}

}  // namespace splatray
