/// File names, and addresses of files on servers, which are written where a file's name may stand.
#pragma once
#include <filesystem>
#include <string>

#include "preprocess/base/lower_case.h"

namespace splatray {

/// Whether it is an address of http or https.
[[nodiscard]] inline bool is_url(const std::filesystem::path& path) {
  const std::string start = lower_case(path.native().substr(0, 8));
  return start.starts_with("http://") || start.starts_with("https://");
}

/// The extension with its dot, in lower case: "A.PLY" -> ".ply". Of an address that of its path, before "?" and "#".
[[nodiscard]] inline std::string lower_extension(const std::filesystem::path& path) {
  if (!is_url(path)) return lower_case(path.extension().string());
  const std::string& url = path.native();
  return lower_case(std::filesystem::path(url.substr(0, url.find_first_of("?#"))).extension().string());
}

}  // namespace splatray
