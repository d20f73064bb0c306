/// What of a folder can be opened.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace splatray {

struct FolderEntry {
  std::string name;
  bool is_folder = false;
  std::uint64_t bytes = 0;  ///< of a file
};

struct FolderListing {
  std::filesystem::path folder;
  std::vector<FolderEntry> entries;  ///< folders, then scenes and what makes them, by name; nothing hidden
  std::string error;                 ///< why there are none; empty = nothing went wrong
};

/// At most as many entries as a person looks through; the error says so where there are more.
[[nodiscard]] FolderListing list_folder(const std::filesystem::path& folder);

/// "1.2 MB"
[[nodiscard]] std::string size_text(std::uint64_t bytes);

}  // namespace splatray
