#include "preprocess/read/find_file.h"

#include <cstddef>

#include "preprocess/read/bytes/byte_reader.h"

namespace splatray {

bool stays_inside(const std::filesystem::path& path) {
  std::ptrdiff_t depth = 0;
  for (const std::filesystem::path& step : path) {
    depth += step == ".." ? -1 : step == "." || step.empty() ? 0 : 1;
    if (depth < 0) {
      return false;
    }
  }
  return path.is_relative();
}

std::filesystem::path find_scene_file(const FileReference& file,
                                      const std::vector<std::filesystem::path>& data_paths) {
  const std::filesystem::path name(file.name);
  if (!stays_inside(name)) {
    throw_unreadable(file.scene, file.what + ": found '" + file.name +
                                     "', expected a file in the scene's folder or in a data path, or below");
  }
  std::vector<std::filesystem::path> candidates{file.scene.parent_path() / name};
  for (const std::filesystem::path& folder : data_paths) {
    candidates.push_back(folder / name);
    if (name.has_parent_path()) {
      candidates.push_back(folder / name.filename());
    }
  }
  std::string looked;
  for (const std::filesystem::path& candidate : candidates) {
    std::error_code error;
    if (std::filesystem::is_regular_file(candidate, error)) {
      return candidate;
    }
    looked += (looked.empty() ? "" : ", ") + candidate.string();
  }
  throw_unreadable(file.scene, file.what + ": '" + file.name + "' was not found, looked for " + looked +
                                   (file.hint.empty() ? "" : "; " + file.hint));
}

}  // namespace splatray
