/// The files of a scene: which they are, and how they are called.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace splatray {

/// Files and folders that make one scene together.
using SceneFiles = std::vector<std::filesystem::path>;

/// A file's absolute path without detours; as it is where there is no such path.
[[nodiscard]] std::filesystem::path plain_path(const std::filesystem::path& file);

/// "dragon.ply", "dragon.ply and 2 more".
[[nodiscard]] std::string scene_title(const SceneFiles& files);

/// What a scene's bookmarks are kept by: the plain path of its first file, so that files that are added leave them.
[[nodiscard]] std::string scene_name(const SceneFiles& files);

}  // namespace splatray
