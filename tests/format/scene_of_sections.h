/// Scene files of version 15 taken apart and put together, written from the table in engine/file/scene_file.h alone.
#pragma once
#include <algorithm>
#include <string>
#include <vector>

#include "tests/format/scene_bytes.h"

namespace splatray {

struct FileSection {
  std::string name;
  std::uint32_t type, element_bytes, flags;
  Bytes content;
};

using FileSections = std::vector<FileSection>;

inline FileSections sections_of(const Bytes& bytes) {
  FileSections sections;
  for (std::size_t entry = NAMED.begin; entry < head_bytes(bytes); entry += NAMED.entry)
    sections.push_back(
        {bytes.data() + entry, get<std::uint32_t>(bytes, entry + 24), get<std::uint32_t>(bytes, entry + 28),
         get<std::uint32_t>(bytes, entry + 32),
         bytes.substr(get<std::uint64_t>(bytes, entry + 40), get<std::uint64_t>(bytes, entry + 48))});
  return sections;
}

/// The section of this name. Throws where there is none.
inline FileSection& section_in(FileSections& sections, const std::string& name) {
  for (FileSection& section : sections)
    if (section.name == name) return section;
  throw std::out_of_range(name);
}

inline FileSections without(FileSections sections, const std::string& name) {
  sections.erase(
      std::remove_if(sections.begin(), sections.end(), [&](const auto& one) { return one.name == name; }),
      sections.end());
  return sections;
}

/// The whole file, with right checksums.
inline Bytes file_of(const FileSections& sections) {
  Bytes bytes(NAMED.begin + sections.size() * NAMED.entry, '\0');
  const auto pad = [&] { bytes.resize((bytes.size() + 15) / 16 * 16); };
  for (std::size_t i = 0; i < sections.size(); ++i) {
    const auto& [name, type, element_bytes, flags, content] = sections[i];
    const std::size_t entry = NAMED.begin + i * NAMED.entry;
    pad();
    bytes.replace(entry, name.size(), name);
    put(bytes, entry + 24, type);
    put(bytes, entry + 28, element_bytes);
    put(bytes, entry + 32, flags);
    put<std::uint64_t>(bytes, entry + 40, bytes.size());
    put<std::uint64_t>(bytes, entry + 48, content.size());
    bytes += content;
  }
  pad();
  bytes += "SOCT.END";
  bytes.replace(0, 4, "SOCT");
  put<std::uint32_t>(bytes, 4, 15);
  put<std::uint32_t>(bytes, 8, 0x01020304);
  put(bytes, 12, static_cast<std::uint32_t>(NAMED.begin + sections.size() * NAMED.entry));
  put<std::uint64_t>(bytes, 16, bytes.size());
  put(bytes, 32, static_cast<std::uint32_t>(sections.size()));
  put(bytes, 36, static_cast<std::uint32_t>(NAMED.entry));
  reseal(bytes);
  return bytes;
}

}  // namespace splatray
