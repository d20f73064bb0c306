/// Large arrays of this program lie on huge pages: it fills and goes through hundreds of megabytes, and the kernel takes as
/// long to hand out the 512 pages of 4 KiB in one of 2 MiB as the program takes to fill them.
#include <sys/mman.h>

#include <cstdint>
#include <cstdlib>
#include <new>

namespace {

constexpr std::uintptr_t HUGE_PAGE = std::uintptr_t{1} << 21;

/// Asks for huge pages where an array covers them entirely, so that none takes more memory than without.
void advise(void* memory, std::size_t size) {
  const auto begin = reinterpret_cast<std::uintptr_t>(memory);
  const std::uintptr_t first = (begin + HUGE_PAGE - 1) & ~(HUGE_PAGE - 1);
  const std::uintptr_t end = (begin + size) & ~(HUGE_PAGE - 1);
  if (first < end)
    madvise(reinterpret_cast<void*>(first), end - first, MADV_HUGEPAGE);  // or not: all the same
}

}  // namespace

void* operator new(std::size_t size) {
  void* memory = std::malloc(size > 0 ? size : 1);
  while (memory == nullptr) {
    const std::new_handler handler = std::get_new_handler();
    if (handler == nullptr) throw std::bad_alloc();
    handler();
    memory = std::malloc(size > 0 ? size : 1);
  }
  if (size >= 2 * HUGE_PAGE) advise(memory, size);
  return memory;
}

void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
