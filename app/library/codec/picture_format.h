/// The formats of pictures that are written, by the file's name.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>

#include "preprocess/base/file_extension.h"

namespace splatray {

/// In sentences about names of pictures.
inline constexpr const char* PICTURE_NAMES = ".png, .jpg, .webp or .exr";

[[nodiscard]] inline bool is_jpeg(const std::filesystem::path& path) {
  const std::string extension = lower_extension(path);
  return extension == ".jpg" || extension == ".jpeg";
}
[[nodiscard]] inline bool is_webp(const std::filesystem::path& path) {
  return lower_extension(path) == ".webp";
}

/// Whether the file is for displays: 8 bits a channel, sRGB, after exposure and tone.
[[nodiscard]] inline bool is_display_format(const std::filesystem::path& path) {
  return lower_extension(path) == ".png" || is_jpeg(path) || is_webp(path);
}

/// Whether it is a picture's at all: that, or an EXR.
[[nodiscard]] inline bool is_picture_format(const std::filesystem::path& path) {
  return is_display_format(path) || lower_extension(path) == ".exr";
}

/// Whether a sheet's file has its lines as lines, not as pixels.
[[nodiscard]] inline bool is_line_format(const std::filesystem::path& path) {
  const std::string extension = lower_extension(path);
  return extension == ".svg" || extension == ".pdf" || extension == ".dxf";
}

/// Most pixels of a side that the file can have: 14 bits of WebP (RFC 9649, section 2.5), else more than any picture here.
[[nodiscard]] inline std::uint32_t most_side(const std::filesystem::path& path) {
  return is_webp(path) ? 16383U : 32768U;
}

}  // namespace splatray
