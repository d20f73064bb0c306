#include "engine/device/queue.h"

#include <algorithm>
#include <atomic>

#include "engine/device/paged_buffer.h"

namespace splatray {

std::uint64_t next_id() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

bool Paging::paged() const {
  return std::any_of(pages.begin(), pages.end(), [](std::uint32_t count) { return count > 1; });
}

void Bindings::bind(std::uint32_t binding, const PagedBuffer& buffer) {
  for (std::uint32_t page = 0; page < buffer.pages().size(); ++page)
    bind(binding, *buffer.pages()[page], page);
}

void Queue::reserve(std::unique_ptr<Buffer>& buffer, std::uint64_t bytes) {
  if (buffer && buffer->size() >= bytes) return;
  finish();
  buffer = make_buffer(bytes);
}

}  // namespace splatray
