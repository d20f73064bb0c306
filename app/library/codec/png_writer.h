/// PNGs as they are written (PNG specification, third edition, 2025): 8 bits a channel, rows filtered, compressed by libdeflate.
#pragma once
#include <vector>

#include "app/library/codec/image_codec.h"

namespace splatray {

/// A whole PNG in memory. `values`: rows from the top, a byte a channel, of 3 or 4 channels. Beside the pixels it says that its
/// colours are sRGB, how large its pixels are on paper unless `dots_per_inch` is 0, and, in text chunks, the attributes whose names
/// begin with "splatray."; where one is splatray.projection, equirectangular, of a whole picture, that it is a panorama. Throws std::bad_alloc.
[[nodiscard]] std::vector<unsigned char> encode_png(const PictureHeader& header, const unsigned char* values);

}  // namespace splatray
