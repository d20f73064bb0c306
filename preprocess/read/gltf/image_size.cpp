#include "preprocess/read/gltf/image_size.h"

#include <cstring>

namespace splatray {
namespace {

std::uint64_t big_endian(std::span<const unsigned char> bytes) {
  std::uint64_t value = 0;
  for (const unsigned char byte : bytes) value = value << 8U | byte;
  return value;
}

/// The size in the first frame header (SOF), which stands behind segments of any kind (ITU T.81, annex B).
std::optional<std::uint64_t> jpeg_pixels(std::span<const unsigned char> bytes) {
  constexpr std::size_t FRAME_BYTES = 9;  // marker, length, precision, height, width
  for (std::size_t at = 2; at + FRAME_BYTES <= bytes.size();) {
    if (bytes[at] != 0xFF || bytes[at + 1] == 0xFF) {
      ++at;  // fill
      continue;
    }
    const unsigned char marker = bytes[at + 1];
    const bool is_frame =
        marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
    if (is_frame) return big_endian(bytes.subspan(at + 5, 2)) * big_endian(bytes.subspan(at + 7, 2));
    const bool is_alone = marker == 0 || marker == 0x01 || (marker >= 0xD0 && marker <= 0xD8);
    at += is_alone ? 2 : 2 + big_endian(bytes.subspan(at + 2, 2));
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::uint64_t> image_pixels(std::span<const unsigned char> bytes) {
  static constexpr unsigned char PNG[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
  constexpr std::size_t PNG_HEADER_BYTES = 24;
  if (bytes.size() >= PNG_HEADER_BYTES && std::memcmp(bytes.data(), PNG, sizeof PNG) == 0) {
    return big_endian(bytes.subspan(16, 4)) * big_endian(bytes.subspan(20, 4));
  }
  if (bytes.size() >= 2 && bytes[0] == 0xFF && bytes[1] == 0xD8) return jpeg_pixels(bytes);
  return std::nullopt;
}

}  // namespace splatray
