/// A buffer in pages, for what is larger than a device lets one buffer be.
#pragma once
#include <span>
#include <vector>

#include "engine/device/queue.h"

namespace splatray {

/// Move-only. Where its bytes fit one page, there is one page of that size; else all but the last are full.
class PagedBuffer {
 public:
  PagedBuffer() = default;
  /// As Queue::make_buffer; `page_bytes` is a whole number of elements.
  PagedBuffer(Queue& queue, std::uint64_t bytes, std::uint64_t page_bytes);

  /// One page, of a buffer that is there.
  explicit PagedBuffer(std::unique_ptr<Buffer> page) : page_bytes_(UINT64_MAX) {
    pages_.push_back(std::move(page));
  }

  /// As Queue::upload.
  void upload(Queue& queue, std::span<const std::byte> bytes, std::uint64_t begin = 0);

  [[nodiscard]] std::span<const std::unique_ptr<Buffer>> pages() const { return pages_; }

 private:
  std::vector<std::unique_ptr<Buffer>> pages_;
  std::uint64_t page_bytes_ = 0;
};

}  // namespace splatray
