/// What OpenImageIO does for image_file.cpp, as a library of its own that is loaded with the first picture: OpenImageIO and
/// the 200 libraries it needs take 0.2 s to load, for which programs do not wait that need no picture file, or not yet.
#pragma once
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace splatray {

/// A picture file but for its pixels.
struct PictureHeader {
  int width = 0, height = 0, depth = 1;
  std::vector<std::string> channels;  ///< their names
  bool integers = false;              ///< 8 or 16 bits a channel, else floats
  std::vector<std::pair<std::string, std::string>> attributes;
};

/// The library's functions. They return whether all went well; `error` is OpenImageIO's word where not.
struct ImageCodec {
  /// Whether it is a picture file.
  bool (*read_header)(const std::string& path, PictureHeader& header);
  /// The first `channels` channels of each pixel, 8 and 16 bits as 0..1.
  bool (*read_pixels)(const std::string& path, int channels, float* values, std::string& error);
  /// `format` is the name OpenImageIO has for it; `values` are bytes where header.integers, else floats.
  bool (*write)(const std::string& path, const char* format, const PictureHeader& header, const void* values,
                std::string& error);
};

}  // namespace splatray

/// The library's only symbol.
extern "C" const splatray::ImageCodec* splatray_image_codec();
