/// The bytes of a scene file (engine/file/scene_file.h), for tests that damage or forge them.
#pragma once
#include <cstdint>
#include <cstring>
#include <string>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace splatray {

using Bytes = std::string;

constexpr std::size_t HEADER = 1760, TABLE = 288, ENTRY = 32;

template <typename T>
T get(const Bytes& bytes, std::size_t offset) {
  T value;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

template <typename T>
void put(Bytes& bytes, std::size_t offset, T value) {
  std::memcpy(bytes.data() + offset, &value, sizeof value);
}

/// Makes the header's checksum right again.
inline void reseal_header(Bytes& bytes) {
  put<std::uint64_t>(bytes, 24, 0);
  put<std::uint64_t>(bytes, 24, XXH3_64bits(bytes.data(), HEADER));
}

/// Makes all checksums right again, as someone who forges a file would. The section table must stay inside the bytes.
inline void reseal(Bytes& bytes) {
  for (std::size_t entry = TABLE; entry < HEADER; entry += ENTRY) {
    const auto offset = get<std::uint64_t>(bytes, entry + 8), size = get<std::uint64_t>(bytes, entry + 16);
    put<std::uint64_t>(bytes, entry + 24, XXH3_64bits(bytes.data() + offset, size));
  }
  reseal_header(bytes);
}

}  // namespace splatray
