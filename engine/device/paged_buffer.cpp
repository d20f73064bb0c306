#include "engine/device/paged_buffer.h"

#include <algorithm>
#include <cassert>

namespace splatray {

PagedBuffer::PagedBuffer(const Context& context, VkDeviceSize bytes, VkDeviceSize page_bytes,
                         VkBufferUsageFlags usage, VkFormat texel_format)
    : page_bytes_(page_bytes) {
  assert(page_bytes > 0);
  VkDeviceSize left = bytes;
  do {
    const VkDeviceSize page = std::min(left, page_bytes);
    pages_.emplace_back(context, page, usage, texel_format);
    left -= page;
  } while (left > 0);
}

void PagedBuffer::upload(CommandQueue& queue, std::span<const std::byte> bytes, VkDeviceSize begin) {
  while (!bytes.empty()) {
    const VkDeviceSize at = begin % page_bytes_;
    const std::size_t count = std::min<std::size_t>(bytes.size(), page_bytes_ - at);
    assert(begin / page_bytes_ < pages_.size());
    pages_[begin / page_bytes_].upload(queue, bytes.first(count), at);
    bytes = bytes.subspan(count);
    begin += count;
  }
}

}  // namespace splatray
