#include "engine/device/vulkan/buffer.h"

#include <algorithm>
#include <cassert>
#include <cstring>

#include "engine/base/error.h"
#include "engine/device/vulkan/command_queue.h"

namespace splatray {
namespace {

constexpr VkDeviceSize LEAST_BYTES = 16;
constexpr VkMemoryPropertyFlags COHERENT =
    VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
/// Uncached memory is mapped too, but reading it back is slower than a copy through staging.
constexpr VkMemoryPropertyFlags MAPPABLE = COHERENT | VK_MEMORY_PROPERTY_HOST_CACHED_BIT;

/// The first memory type among `allowed` (a bit each) with all of `wanted`, or UINT32_MAX.
std::uint32_t memory_type(const Context& context, std::uint32_t allowed, VkMemoryPropertyFlags wanted) {
  for (std::uint32_t i = 0; i < context.memory.memoryTypeCount; ++i) {
    const bool has_all = (context.memory.memoryTypes[i].propertyFlags & wanted) == wanted;
    if ((allowed >> i & 1U) != 0 && has_all) return i;
  }
  return UINT32_MAX;
}

std::uint32_t preferred_memory_type(const Context& context, std::uint32_t allowed, Residence residence) {
  VkMemoryPropertyFlags best = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, second = 0;
  if (residence == Residence::host) {
    best = MAPPABLE;
    second = COHERENT;
  }
  const std::uint32_t type = memory_type(context, allowed, best);
  return type != UINT32_MAX ? type : memory_type(context, allowed, second);
}

}  // namespace

Memory allocate_memory(const Context& context, const VkMemoryRequirements& needs, Residence residence) {
  VkMemoryAllocateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
  info.allocationSize = needs.size;
  info.memoryTypeIndex = preferred_memory_type(context, needs.memoryTypeBits, residence);
  assert(info.memoryTypeIndex != UINT32_MAX);
  VkDeviceMemory memory = VK_NULL_HANDLE;
  check(vkAllocateMemory(context.device, &info, nullptr, &memory),
        ("allocating " + std::to_string(needs.size) + " bytes on the device").c_str());
  const VkMemoryPropertyFlags flags = context.memory.memoryTypes[info.memoryTypeIndex].propertyFlags;
  return {{context.device, memory}, residence == Residence::host || (flags & MAPPABLE) == MAPPABLE};
}

Buffer::Buffer(const Context& context, VkDeviceSize bytes, VkBufferUsageFlags usage, VkFormat texel_format,
               Residence residence)
    : size_(std::max(bytes, LEAST_BYTES)) {
  if (context.is_host()) {
    host_ = std::make_unique_for_overwrite<std::byte[]>(size_);
    mapped_ = host_.get();
    return;
  }
  VkBufferCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
  info.size = size_;
  info.usage = usage | VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
  VkBuffer buffer = VK_NULL_HANDLE;
  check(vkCreateBuffer(context.device, &info, nullptr, &buffer), "making a buffer");
  buffer_ = {context.device, buffer};

  VkMemoryRequirements needs{};
  vkGetBufferMemoryRequirements(context.device, buffer, &needs);
  memory_ = allocate_memory(context, needs, residence);
  check(vkBindBufferMemory(context.device, buffer, memory_.handle.get(), 0), "binding a buffer's memory");
  if (memory_.mappable) {
    void* pointer = nullptr;
    check(vkMapMemory(context.device, memory_.handle.get(), 0, VK_WHOLE_SIZE, 0, &pointer),
          "mapping a buffer");
    mapped_ = static_cast<std::byte*>(pointer);
  }
  if (texel_format == VK_FORMAT_UNDEFINED) return;
  VkBufferViewCreateInfo view_info{};
  view_info.sType = VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO;
  view_info.buffer = buffer;
  view_info.format = texel_format;
  view_info.range = VK_WHOLE_SIZE;
  VkBufferView view = VK_NULL_HANDLE;
  check(vkCreateBufferView(context.device, &view_info, nullptr, &view), "making a texel view of a buffer");
  view_ = {context.device, view};
}

void Buffer::upload(CommandQueue& queue, std::span<const std::byte> bytes, VkDeviceSize begin) {
  assert(begin + bytes.size() <= size_);
  if (bytes.empty()) return;
  if (mapped_ != nullptr) {
    std::memcpy(mapped_ + begin, bytes.data(), bytes.size());
    return;
  }
  const Buffer& staging = queue.staging(bytes.size());
  for (std::size_t at = 0; at < bytes.size(); at += staging.size()) {
    const std::size_t count = std::min<std::size_t>(staging.size(), bytes.size() - at);
    std::memcpy(staging.mapped(), bytes.data() + at, count);
    queue.run([&](VkCommandBuffer commands) {
      const VkBufferCopy region{0, begin + at, count};
      vkCmdCopyBuffer(commands, staging.get(), get(), 1, &region);
    });
  }
}

void Buffer::download(CommandQueue& queue, std::span<std::byte> bytes) const {
  assert(bytes.size() <= size_);
  if (bytes.empty()) return;
  if (mapped_ != nullptr) {
    std::memcpy(bytes.data(), mapped_, bytes.size());
    return;
  }
  const Buffer& staging = queue.staging(bytes.size());
  for (std::size_t at = 0; at < bytes.size(); at += staging.size()) {
    const std::size_t count = std::min<std::size_t>(staging.size(), bytes.size() - at);
    queue.run([&](VkCommandBuffer commands) {
      const VkBufferCopy region{at, 0, count};
      vkCmdCopyBuffer(commands, get(), staging.get(), 1, &region);
    });
    std::memcpy(bytes.data() + at, staging.mapped(), count);
  }
}

void reserve_storage(const Context& context, Buffer& buffer, VkDeviceSize bytes, VkFormat texel_format) {
  const bool texels = texel_format != VK_FORMAT_UNDEFINED;
  const VkBufferUsageFlags texel_usage = texels ? VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT : 0;
  if (buffer.size() < std::max(bytes, LEAST_BYTES))
    buffer = Buffer(context, bytes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | texel_usage, texel_format);
}

}  // namespace splatray
