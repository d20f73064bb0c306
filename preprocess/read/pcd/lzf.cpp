#include "preprocess/read/pcd/lzf.h"

#include <algorithm>

namespace splatray {

std::size_t decompress_lzf(std::span<const unsigned char> from, std::span<unsigned char> to) {
  constexpr unsigned LONG_REPEAT = 7;  // of three bits: another byte follows
  std::size_t in = 0;
  std::size_t out = 0;
  while (in < from.size() && out < to.size()) {
    const unsigned control = from[in++];
    if (control < 32) {
      const std::size_t length = std::min({std::size_t{control} + 1, from.size() - in, to.size() - out});
      std::copy_n(from.begin() + static_cast<std::ptrdiff_t>(in), length,
                  to.begin() + static_cast<std::ptrdiff_t>(out));
      in += length;
      out += length;
      continue;
    }
    std::size_t length = control >> 5U;
    if (length == LONG_REPEAT && in < from.size()) length += from[in++];
    if (in == from.size()) break;
    const std::size_t back = ((std::size_t{control} & 31U) << 8U) + from[in++] + 1;
    if (back > out) break;
    // Byte by byte: what is repeated may be what this has just written.
    for (const std::size_t end = std::min(out + length + 2, to.size()); out < end; ++out)
      to[out] = to[out - back];
  }
  return out;
}

}  // namespace splatray
