/// Memory on the device: buffers, with a texel view where asked.
#pragma once
#include <cstddef>
#include <memory>
#include <span>

#include "engine/device/vulkan/handle.h"
#include "engine/device/vulkan/vulkan_device.h"

namespace splatray {

class CommandQueue;

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
[[nodiscard]] Memory allocate_memory(const Context& context, const VkMemoryRequirements& needs,
                                     Residence residence);

/// Move-only buffer with its own memory; at least 16 bytes, so that an empty array still has a valid
/// descriptor.
class Buffer {
 public:
  Buffer() = default;
  /// Transfers to and from it are always allowed. `texel_format` other than undefined adds a view of the
  /// whole buffer.
  Buffer(const Context& context, VkDeviceSize bytes, VkBufferUsageFlags usage,
         VkFormat texel_format = VK_FORMAT_UNDEFINED, Residence residence = Residence::device);

  /// Copies to the buffer's bytes from `begin` on, or from its start; at most to its end. Waits until done.
  void upload(CommandQueue& queue, std::span<const std::byte> bytes, VkDeviceSize begin = 0);
  void download(CommandQueue& queue, std::span<std::byte> bytes) const;

  [[nodiscard]] VkBuffer get() const { return buffer_.get(); }
  /// The texel view, or VK_NULL_HANDLE.
  [[nodiscard]] VkBufferView view() const { return view_.get(); }
  [[nodiscard]] VkDeviceSize size() const { return size_; }
  /// The content in host memory, or null where the memory is not mappable.
  [[nodiscard]] std::byte* mapped() const { return mapped_; }

 private:
  Memory memory_;
  std::unique_ptr<std::byte[]> host_;  ///< of a context that is the host, in place of all else
  Handle<VkBuffer, vkDestroyBuffer> buffer_;
  Handle<VkBufferView, vkDestroyBufferView> view_;
  VkDeviceSize size_ = 0;
  std::byte* mapped_ = nullptr;
};

/// Makes a storage buffer at least that large; keeps it when it is.
void reserve_storage(const Context& context, Buffer& buffer, VkDeviceSize bytes,
                     VkFormat texel_format = VK_FORMAT_UNDEFINED);

}  // namespace splatray
