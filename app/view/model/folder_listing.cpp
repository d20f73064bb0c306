#include "app/view/model/folder_listing.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <tuple>

#include "app/view/model/scene_files.h"
#include "preprocess/base/file_extension.h"
#include "preprocess/read/formats.h"

namespace splatray {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t MOST_ENTRIES = 5000;

bool can_be_opened(const fs::path& file) { return is_scene_file(file) || find_format(file) != nullptr; }

}  // namespace

FolderListing list_folder(const fs::path& folder) {
  FolderListing listing;
  listing.folder = plain_path(folder);
  std::error_code failed;
  for (fs::directory_iterator entry(listing.folder, failed), end; !failed && entry != end;
       entry.increment(failed)) {
    std::error_code gone;
    const std::string name = entry->path().filename().string();
    const bool is_folder = entry->is_directory(gone);
    if (name.starts_with(".") || (!is_folder && !can_be_opened(entry->path()))) continue;
    const std::uintmax_t bytes = is_folder ? 0 : entry->file_size(gone);
    listing.entries.push_back({name, is_folder, gone ? 0 : bytes});
    if (listing.entries.size() <= MOST_ENTRIES) continue;
    listing.entries.pop_back();
    listing.error = "the first " + std::to_string(MOST_ENTRIES) + " of more";
    break;
  }
  if (failed) listing.error = failed.message();
  std::sort(listing.entries.begin(), listing.entries.end(), [](const FolderEntry& a, const FolderEntry& b) {
    return std::tuple(!a.is_folder, a.name) < std::tuple(!b.is_folder, b.name);
  });
  return listing;
}

std::string size_text(std::uint64_t bytes) {
  constexpr std::array UNITS = {"kB", "MB", "GB", "TB"};
  double value = static_cast<double>(bytes) / 1000.0;
  std::size_t unit = 0;
  for (; value >= 1000.0 && unit + 1 < UNITS.size(); ++unit) value /= 1000.0;
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), value < 10.0 ? "%.1f %s" : "%.0f %s", value, UNITS.at(unit));
  return text.data();
}

}  // namespace splatray
