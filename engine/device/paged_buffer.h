/// A buffer in pages, for what is larger than a device lets one buffer be.
#pragma once
#include <span>
#include <vector>

#include "engine/device/vulkan/buffer.h"

namespace splatray {

/// Move-only. Where its bytes fit one page, there is one page of that size; else all but the last are full.
class PagedBuffer {
 public:
  PagedBuffer() = default;
  /// As Buffer's constructor; `page_bytes` is a whole number of texels.
  PagedBuffer(const Context& context, VkDeviceSize bytes, VkDeviceSize page_bytes, VkBufferUsageFlags usage,
              VkFormat texel_format);

  /// As Buffer::upload.
  void upload(CommandQueue& queue, std::span<const std::byte> bytes, VkDeviceSize begin = 0);

  [[nodiscard]] std::span<const Buffer> pages() const { return pages_; }

 private:
  std::vector<Buffer> pages_;
  VkDeviceSize page_bytes_ = 0;
};

}  // namespace splatray
