/// OpenEXR pictures as they are written: 32-bit floats, compressed by libdeflate.
#pragma once
#include <vector>

#include "app/library/codec/image_codec.h"

namespace splatray {

/// A whole file in memory. `values`: rows from the top, a float a channel, in the header's order. Its attributes are those whose names
/// begin with "splatray.". Throws std::bad_alloc, and std::runtime_error where OpenEXR refuses the header.
[[nodiscard]] std::vector<unsigned char> encode_exr(const PictureHeader& header, const float* values);

}  // namespace splatray
