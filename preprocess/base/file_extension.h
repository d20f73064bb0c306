/// File names.
#pragma once
#include <filesystem>
#include <string>

#include "preprocess/base/lower_case.h"

namespace splatray {

/// The extension with its dot, in lower case: "A.PLY" -> ".ply".
[[nodiscard]] inline std::string lower_extension(const std::filesystem::path& path) {
  return lower_case(path.extension().string());
}

}  // namespace splatray
