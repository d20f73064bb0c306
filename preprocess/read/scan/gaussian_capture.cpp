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
constexpr std::string_view PROPERTIES[] = {"f_dc_0", "rot_0", "packed_position"};

template <typename List>
bool holds(const List& list, const std::string& name) {
  return std::find(std::begin(list), std::end(list), name) != std::end(list);
}

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& sign) {
  throw_unreadable(path,
                   "found a capture of 3D Gaussians (" + sign +
                       "), expected points: export its centres as a PLY with x, y, z and red, green, blue");
}

}  // namespace

void refuse_gaussian_file(const std::filesystem::path& path) {
  const std::string extension = lower_extension(path);
  if (holds(EXTENSIONS, extension)) refuse(path, extension);
}

void refuse_gaussian_names(const std::filesystem::path& path, const std::vector<std::string>& names) {
  constexpr std::string_view OF_GLTF = "gaussian_splatting";
  for (const std::string& name : names) {
    const std::string lower = lower_case(name);
    if (holds(PROPERTIES, lower) || lower.find(OF_GLTF) != std::string::npos) refuse(path, "'" + name + "'");
  }
}

}  // namespace splatray
