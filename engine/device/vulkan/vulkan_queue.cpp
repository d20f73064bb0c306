#include "engine/device/vulkan/vulkan_queue.h"

#include <algorithm>
#include <cassert>

#include "engine/device/vulkan/fused_products.h"
#include "engine/device/vulkan/texture.h"

namespace splatray {

VulkanQueue::VulkanQueue(const VulkanDevice& vulkan, const QueueOptions& options)
    : vulkan_(vulkan),
      pipelines_(vulkan, options.pipeline_folder),
      frame_(vulkan, sizeof(FrameParams), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT),
      counters_(vulkan, COUNTER_COUNT * sizeof(std::uint32_t), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT),
      commands_(vulkan),
      fuses_(finds_remainders(vulkan, commands_, exact_products())) {}

std::unique_ptr<Buffer> VulkanQueue::make_buffer(std::uint64_t bytes) {
  return std::make_unique<VulkanBuffer>(vulkan_, bytes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
}

std::unique_ptr<DeviceTexture> VulkanQueue::make_texture(const Environment& environment) {
  return std::make_unique<EnvironmentTexture>(vulkan_, commands_, environment);
}

std::unique_ptr<Bindings> VulkanQueue::make_bindings(const Paging& paging) {
  auto bindings = std::make_unique<VulkanBindings>(vulkan_, commands_, paging);
  bindings->bind(BIND_FRAME, frame_, 0);
  bindings->bind(BIND_COUNTERS, counters_, 0);
  return bindings;
}

void VulkanQueue::upload(Buffer& buffer, std::span<const std::byte> bytes, std::uint64_t begin) {
  commands_.upload(static_cast<VulkanBuffer&>(buffer), bytes, begin);
}

void VulkanQueue::download(const Buffer& buffer, std::span<std::byte> bytes) {
  commands_.download(static_cast<const VulkanBuffer&>(buffer), bytes);
}

void VulkanQueue::prepare(const Dispatch& dispatch, const Bindings& bindings) {
  pipelines_.prepare({dispatch.program, dispatch.constants},
                     static_cast<const VulkanBindings&>(bindings).layout());
}

void VulkanQueue::record(const Dispatch& dispatch, const VulkanBindings& bound, VkCommandBuffer commands) {
  const VkPipeline pipeline = pipelines_.get({dispatch.program, dispatch.constants}, bound.layout());
  vkCmdUpdateBuffer(commands, frame_.get(), 0, sizeof(FrameParams), &dispatch.frame);
  if (dispatch.counts_work()) vkCmdFillBuffer(commands, counters_.get(), 0, VK_WHOLE_SIZE, 0);
  record_barrier(commands);
  const VkDescriptorSet set = bound.set();
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
  vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, bound.layout()->get(), 0, 1, &set, 0,
                          nullptr);
  vkCmdDispatch(commands, dispatch.groups_x, dispatch.groups_y, 1);
}

Ran VulkanQueue::run(const Dispatch& dispatch, const Bindings& bindings) {
  Ran ran;
  ran.ms = commands_.run([&](VkCommandBuffer commands) {
    record(dispatch, static_cast<const VulkanBindings&>(bindings), commands);
  });
  if (!dispatch.counts_work()) return ran;
  std::array<std::uint32_t, COUNTER_COUNT> counted{};
  commands_.download(counters_, std::as_writable_bytes(std::span(counted)));
  std::copy(counted.begin(), counted.end(), ran.counted.begin());
  return ran;
}

void VulkanQueue::begin(const Dispatch& dispatch, const Bindings& bindings) {
  assert(!dispatch.counts_work());
  commands_.begin([&](VkCommandBuffer commands) {
    record(dispatch, static_cast<const VulkanBindings&>(bindings), commands);
  });
}

std::unique_ptr<Queue> VulkanDevice::make_queue(const QueueOptions& options) const {
  return std::make_unique<VulkanQueue>(*this, options);
}

}  // namespace splatray
