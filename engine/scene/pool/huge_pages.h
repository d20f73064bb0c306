/// Memory in huge pages, of 2 MiB: where an array is read here and there, addresses of few pages are looked up, not of thousands.
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

namespace splatray {

inline constexpr std::uint64_t HUGE_PAGE_BYTES = std::uint64_t{2} << 20U;

/// Whether arrays of so many bytes are copied into huge pages, once so many rays of a camera are to go through them and so much memory is
/// available. The copy takes about as long as a ray for each 32 bytes of it saves, so that it is made when what was lost without it
/// reaches what it takes; an eighth of the memory leaves room for others. Fewer bytes than a huge page has need none.
[[nodiscard]] constexpr bool worth_huge_pages(std::uint64_t bytes, std::uint64_t rays,
                                              std::uint64_t available_bytes) {
  constexpr std::uint64_t BYTES_A_RAY = 32, SHARE = 8;
  return bytes >= HUGE_PAGE_BYTES && bytes / BYTES_A_RAY <= rays && bytes <= available_bytes / SHARE;
}

/// A copy that begins at a multiple of HUGE_PAGE_BYTES, made by all cores; in huge pages where the kernel has them, else in its own. Null
/// where there is no memory for it.
[[nodiscard]] std::shared_ptr<const std::byte> copy_in_huge_pages(std::span<const std::byte> bytes);

}  // namespace splatray
