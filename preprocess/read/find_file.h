/// Finds the files a scene names.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace splatray {

/// What a scene says about a file it needs.
struct FileReference {
  std::string name;             ///< as the scene writes it, '/' between folders
  std::string what;             ///< for the message: "points of node 'dragon'"
  std::string hint;             ///< where to get it; may be empty
  std::filesystem::path scene;  ///< the scene's own file
};

/// Whether a relative path names something in the folder it starts from, or below: it never leaves that by `..`.
[[nodiscard]] bool stays_inside(const std::filesystem::path& path);

/// The first that exists of: the name in the scene's folder; in each data path by relative path, then by file name alone.
/// Throws Error (input_unreadable) for a name that is absolute or leaves its folder, and for what is missing: says where it
/// was looked for and the hint.
[[nodiscard]] std::filesystem::path find_scene_file(const FileReference& file,
                                                    const std::vector<std::filesystem::path>& data_paths);

}  // namespace splatray
