#include "preprocess/read/scan/gaussian_capture.h"

#include <algorithm>
#include <iterator>
#include <string_view>

#include "preprocess/base/file_extension.h"
#include "preprocess/base/lower_case.h"
#include "preprocess/read/bytes/byte_reader.h"

namespace splatray {
namespace {

constexpr std::string_view EXTENSIONS[] = {".spz", ".sog", ".ksplat", ".splat"};

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& sign) {
  throw_unreadable(
      path, "found a capture of 3D Gaussians (" + sign + "), expected points or such a capture as PLY");
}

}  // namespace

void refuse_gaussian_file(const std::filesystem::path& path) {
  const std::string extension = lower_extension(path);
  if (std::find(std::begin(EXTENSIONS), std::end(EXTENSIONS), extension) != std::end(EXTENSIONS))
    refuse(path, extension);
}

void refuse_gaussian_names(const std::filesystem::path& path, const std::vector<std::string>& names) {
  constexpr std::string_view OF_GLTF = "gaussian_splatting";
  for (const std::string& name : names) {
    if (lower_case(name).find(OF_GLTF) != std::string::npos) refuse(path, "'" + name + "'");
  }
}

}  // namespace splatray
