/// What image_file.cpp loads as libraries of their own, by engine/base/module.h: splatray_image_codec (EXR by OpenEXR, PNG by
/// libdeflate and stb, HDR and JPEG by stb), and splatray_oiio (OpenImageIO and the 200 libraries it needs), which writes WebP and
/// reads files of other formats. Strings and vectors cross the border as between any two C++ libraries of one compiler.
#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace splatray {

/// A picture file but for its pixels.
struct PictureHeader {
  int width = 0, height = 0, depth = 1;
  int x = 0, y = 0;                     ///< where its pixels begin in the whole picture
  int full_width = 0, full_height = 0;  ///< of the whole picture; 0: it is the whole one
  std::vector<std::string> channels;    ///< their names
  bool integers = false;                ///< 8 or 16 bits a channel, else floats
  std::vector<std::pair<std::string, std::string>> attributes;
  double dots_per_inch = 0.0;  ///< of a PNG to be written; 0 = it does not say
  int quality = 95;            ///< of a JPEG or WebP to be written, 1 to 100
  /// No file of this one's size and format has more, however well it is compressed; for reading only.
  std::uint64_t most_pixels = ~0ULL;
};

/// Takes the values of further pixels, in the order of rows from the top.
using PixelSink = std::function<void(const float* values, std::size_t pixels)>;

/// The library's functions. They return whether all went well; `error` receives a message on failure.
struct ImageCodec {
  /// Whether it is a picture file.
  bool (*read_header)(const std::string& path, PictureHeader& header);
  /// The first `channels` channels of the rows from `first_row` on, 8 and 16 bits as 0..1. Some rows at a time, so that memory
  /// grows with what the file holds and not with what its header says.
  bool (*read_pixels)(const std::string& path, int first_row, int channels, const PixelSink& sink,
                      std::string& error);
  /// The bytes of a picture's file: "png" or "jpeg" of bytes or "openexr" of floats; OpenImageIO's: "webp" of bytes.
  bool (*encode)(const char* format, const PictureHeader& header, const void* values,
                 std::vector<unsigned char>& bytes, std::string& error);
};

}  // namespace splatray

/// A library's only symbol.
extern "C" const splatray::ImageCodec* splatray_image_codec();
