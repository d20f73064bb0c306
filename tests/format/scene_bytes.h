/// The bytes of a scene file (engine/file/scene_file.h), for tests that damage or forge them.
#pragma once
#include <cstdint>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <string>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace splatray {

using Bytes = std::string;

/// Where the section table begins, bytes of an entry, offset of a section's place in it; its bytes and checksum follow. Of files with
/// named sections, and of those of versions 10 to 14 (engine/file/old_scene_sections.h).
struct TableForm {
  std::size_t begin, entry, place;
};
constexpr TableForm NAMED{48, 64, 40}, OLD{288, 32, 8};

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

inline std::size_t head_bytes(const Bytes& bytes) { return get<std::uint32_t>(bytes, 12); }

/// Where the table of a file of version 15 has a section. Throws where it has none.
inline std::size_t entry_of(const Bytes& bytes, const std::string& name) {
  for (std::size_t entry = NAMED.begin; entry < head_bytes(bytes); entry += NAMED.entry)
    if (name == bytes.data() + entry) return entry;
  throw std::out_of_range(name);
}

/// Where a section of a file of version 15 begins.
inline std::size_t section_offset(const Bytes& bytes, const std::string& name) {
  return get<std::uint64_t>(bytes, entry_of(bytes, name) + NAMED.place);
}

/// Makes the header's checksum right again.
inline void reseal_header(Bytes& bytes) {
  put<std::uint64_t>(bytes, 24, 0);
  put<std::uint64_t>(bytes, 24, XXH3_64bits(bytes.data(), head_bytes(bytes)));
}

/// Makes all checksums right again, as someone who forges a file would. The section table must stay inside the bytes.
inline void reseal(Bytes& bytes, const TableForm& form = NAMED) {
  for (std::size_t entry = form.begin; entry < head_bytes(bytes); entry += form.entry) {
    const std::size_t place = entry + form.place;
    const auto offset = get<std::uint64_t>(bytes, place), size = get<std::uint64_t>(bytes, place + 8);
    put<std::uint64_t>(bytes, place + 16, XXH3_64bits(bytes.data() + offset, size));
  }
  reseal_header(bytes);
}

/// A file of bytes in hexadecimal digits.
inline Bytes read_hex(const std::string& path) {
  std::ifstream file(path);
  Bytes bytes;
  for (std::string pair; file >> pair;) bytes += static_cast<char>(std::stoi(pair, nullptr, 16));
  return bytes;
}

/// The file of scene_of_version(version) as it was written when that version was the newest.
inline Bytes golden_bytes(std::uint32_t version) {
  return read_hex(GOLDEN_FOLDER "/" + std::to_string(version) + ".hex");
}

}  // namespace splatray
