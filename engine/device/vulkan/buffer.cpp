#include "engine/device/vulkan/buffer.h"

#include <algorithm>
#include <cassert>

#include "engine/base/error.h"

namespace splatray {
namespace {

constexpr VkDeviceSize LEAST_BYTES = 16;
constexpr VkMemoryPropertyFlags COHERENT =
    VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
/// Uncached memory is mapped too, but reading it back is slower than a copy through staging.
constexpr VkMemoryPropertyFlags MAPPABLE = COHERENT | VK_MEMORY_PROPERTY_HOST_CACHED_BIT;

/// The first memory type among `allowed` (a bit each) with all of `wanted`, or UINT32_MAX.
std::uint32_t memory_type(const VulkanDevice& vulkan, std::uint32_t allowed, VkMemoryPropertyFlags wanted) {
  for (std::uint32_t i = 0; i < vulkan.memory.memoryTypeCount; ++i) {
    const bool has_all = (vulkan.memory.memoryTypes[i].propertyFlags & wanted) == wanted;
    if ((allowed >> i & 1U) != 0 && has_all) return i;
  }
  return UINT32_MAX;
}

std::uint32_t preferred_memory_type(const VulkanDevice& vulkan, std::uint32_t allowed, Residence residence) {
  VkMemoryPropertyFlags best = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, second = 0;
  if (residence == Residence::host) {
    best = MAPPABLE;
    second = COHERENT;
  }
  const std::uint32_t type = memory_type(vulkan, allowed, best);
  return type != UINT32_MAX ? type : memory_type(vulkan, allowed, second);
}

}  // namespace

Memory allocate_memory(const VulkanDevice& vulkan, const VkMemoryRequirements& needs, Residence residence) {
  VkMemoryAllocateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
  info.allocationSize = needs.size;
  info.memoryTypeIndex = preferred_memory_type(vulkan, needs.memoryTypeBits, residence);
  assert(info.memoryTypeIndex != UINT32_MAX);
  VkDeviceMemory memory = VK_NULL_HANDLE;
  check(vkAllocateMemory(vulkan.device, &info, nullptr, &memory),
        ("allocating " + std::to_string(needs.size) + " bytes on the device").c_str());
  const VkMemoryPropertyFlags flags = vulkan.memory.memoryTypes[info.memoryTypeIndex].propertyFlags;
  return {{vulkan.device, memory}, residence == Residence::host || (flags & MAPPABLE) == MAPPABLE};
}

VulkanBuffer::VulkanBuffer(const VulkanDevice& vulkan, VkDeviceSize bytes, VkBufferUsageFlags usage,
                           Residence residence)
    : Buffer(std::max(bytes, LEAST_BYTES)) {
  VkBufferCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
  info.size = size();
  info.usage = usage | VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
  VkBuffer buffer = VK_NULL_HANDLE;
  check(vkCreateBuffer(vulkan.device, &info, nullptr, &buffer), "making a buffer");
  buffer_ = {vulkan.device, buffer};

  VkMemoryRequirements needs{};
  vkGetBufferMemoryRequirements(vulkan.device, buffer, &needs);
  memory_ = allocate_memory(vulkan, needs, residence);
  check(vkBindBufferMemory(vulkan.device, buffer, memory_.handle.get(), 0), "binding a buffer's memory");
  if (memory_.mappable) {
    void* pointer = nullptr;
    check(vkMapMemory(vulkan.device, memory_.handle.get(), 0, VK_WHOLE_SIZE, 0, &pointer),
          "mapping a buffer");
    mapped_ = static_cast<std::byte*>(pointer);
  }
}

}  // namespace splatray
