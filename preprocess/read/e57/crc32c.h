/// CRC-32C, the checksum of E57's pages.
#pragma once
#include <cstddef>
#include <cstdint>

namespace splatray {

/// CRC-32C (Castagnoli's polynomial, reflected; RFC 3720, appendix B.4) of `size` bytes, eight at a time by eight tables
/// (slicing-by-8: Kounavis and Berry 2008, section 4).
[[nodiscard]] std::uint32_t crc32c(const unsigned char* bytes, std::size_t size);

}  // namespace splatray
