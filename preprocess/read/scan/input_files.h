/// The files that a user's paths stand for.
#pragma once
#include <filesystem>
#include <vector>

namespace splatray {

/// A file to read.
struct InputFile {
  std::filesystem::path path;
  /// It was not named, but lies in a folder that was, and its extension is one that other files have, too: where it is no scan it
  /// is left out with a note.
  bool may_be_left_out;
};

/// The paths; a folder stands for its ept.json or, without one, for those of its files that may be scans (formats.h, and .ply), by
/// name; a list of files stands for these. Throws Error (input_unreadable) for a folder that has none or cannot be listed, and for a
/// list that cannot be read.
[[nodiscard]] std::vector<InputFile> input_files(const std::vector<std::filesystem::path>& paths);

}  // namespace splatray
