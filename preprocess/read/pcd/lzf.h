/// LZF, the compression of PCD files.
#pragma once
#include <cstddef>
#include <span>

namespace splatray {

/// Most bytes that one compressed byte can stand for: three bytes repeat up to 264.
inline constexpr std::size_t LZF_MOST_GAIN = 88;

/// Decompresses LZF (Lehmann, LibLZF: literal runs of up to 32 bytes, and repeats of 3 to 264 bytes up to 8192 bytes back)
/// into `to`. How many bytes were written: fewer than there is place for where the data end or refer to what is not there.
[[nodiscard]] std::size_t decompress_lzf(std::span<const unsigned char> from, std::span<unsigned char> to);

}  // namespace splatray
