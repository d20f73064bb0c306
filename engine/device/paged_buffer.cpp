#include "engine/device/paged_buffer.h"

#include <algorithm>
#include <cassert>

namespace splatray {

PagedBuffer::PagedBuffer(Queue& queue, std::uint64_t bytes, std::uint64_t page_bytes)
    : page_bytes_(page_bytes) {
  assert(page_bytes > 0);
  std::uint64_t left = bytes;
  do {
    const std::uint64_t page = std::min(left, page_bytes);
    pages_.push_back(queue.make_buffer(page));
    left -= page;
  } while (left > 0);
}

void PagedBuffer::upload(Queue& queue, std::span<const std::byte> bytes, std::uint64_t begin) {
  while (!bytes.empty()) {
    const std::uint64_t at = begin % page_bytes_;
    const std::size_t count = std::min<std::size_t>(bytes.size(), page_bytes_ - at);
    assert(begin / page_bytes_ < pages_.size());
    queue.upload(*pages_[begin / page_bytes_], bytes.first(count), at);
    bytes = bytes.subspan(count);
    begin += count;
  }
}

}  // namespace splatray
