/// Vulkan's buffers.
#pragma once
#include <cstddef>
#include <memory>
#include <span>

#include "engine/device/vulkan/handle.h"
#include "engine/device/vulkan/vulkan_device.h"

namespace splatray {

/// Device memory of an object, chosen for its use.
struct Memory {
  Handle<VkDeviceMemory, vkFreeMemory> handle;
  bool mappable = false;  ///< the host reads and writes it directly and fast
};

/// Where memory should be.
enum class Residence {
  device,  ///< near the device
  host,    ///< mappable, for staging
};

/// Allocates memory; throws Error (out_of_memory) naming the size.
[[nodiscard]] Memory allocate_memory(const VulkanDevice& vulkan, const VkMemoryRequirements& needs,
                                     Residence residence);

/// Move-only buffer with its own memory; at least 16 bytes, so that an empty array still has a valid
/// descriptor.
class VulkanBuffer final : public Buffer {
 public:
  VulkanBuffer() = default;
  /// Transfers to and from it are always allowed.
  VulkanBuffer(const VulkanDevice& vulkan, VkDeviceSize bytes, VkBufferUsageFlags usage,
               Residence residence = Residence::device);

  [[nodiscard]] VkBuffer get() const { return buffer_.get(); }
  /// The content in host memory, or null where the memory is not mappable.
  [[nodiscard]] std::byte* mapped() const { return mapped_; }

 private:
  Memory memory_;
  Handle<VkBuffer, vkDestroyBuffer> buffer_;
  std::byte* mapped_ = nullptr;
};

}  // namespace splatray
