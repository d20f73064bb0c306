#include "app/view/model/scene_files.h"

namespace splatray {

std::filesystem::path plain_path(const std::filesystem::path& file) {
  std::error_code failed;
  const std::filesystem::path absolute = std::filesystem::absolute(file, failed).lexically_normal();
  if (failed) return file;
  return absolute.has_filename() ? absolute : absolute.parent_path();
}

std::string scene_title(const SceneFiles& files) {
  const std::string first = plain_path(files.front()).filename().string();
  return files.size() == 1 ? first : first + " and " + std::to_string(files.size() - 1) + " more";
}

std::string scene_name(const SceneFiles& files) { return plain_path(files.front()).string(); }

}  // namespace splatray
