#include "engine/scene/pool/huge_pages.h"

#include <sys/mman.h>

#include "engine/base/all_cores.h"

namespace splatray {
namespace {

std::uint64_t whole_huge_pages(std::uint64_t bytes) {
  return (bytes + HUGE_PAGE_BYTES - 1) / HUGE_PAGE_BYTES * HUGE_PAGE_BYTES;
}

/// Whole huge pages, not touched yet; null where the kernel gives none.
std::shared_ptr<std::byte> huge_pages(std::uint64_t bytes) {
  const std::uint64_t all = bytes + HUGE_PAGE_BYTES;  // the kernel's begin lies between two
  void* const begin = mmap(nullptr, all, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (begin == MAP_FAILED) return nullptr;
  const auto free = [begin, all](std::byte*) { munmap(begin, all); };
  const std::uint64_t behind = reinterpret_cast<std::uintptr_t>(begin) % HUGE_PAGE_BYTES;
  std::byte* const first = static_cast<std::byte*>(begin) + (behind == 0 ? 0 : HUGE_PAGE_BYTES - behind);
  (void)madvise(first, bytes, MADV_HUGEPAGE);  // a kernel without them refuses, and gives small ones
  return {first, free};
}

}  // namespace

std::shared_ptr<const std::byte> copy_in_huge_pages(std::span<const std::byte> bytes) {
  const std::shared_ptr<std::byte> copy = huge_pages(whole_huge_pages(bytes.size()));
  if (copy == nullptr) return nullptr;
  copy_on_all_cores(bytes, copy.get());
  return copy;
}

}  // namespace splatray
