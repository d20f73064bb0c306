/// How far a picture is from what more samples would make of it.
#pragma once
#include <span>
#include <vector>

#include "engine/image/image.h"

namespace splatray {

/// The root of the mean square over rgb of each pixel's difference.
[[nodiscard]] std::vector<float> pixel_errors(std::span<const vec4> a, std::span<const vec4> b);

/// Mean radiance of rgb over all pixels.
[[nodiscard]] double mean_radiance(std::span<const vec4> pixels);

/// The root of the mean square of a picture's Image::error, over its mean radiance; 0 of a black one.
[[nodiscard]] double relative_error(const Image& image);

}  // namespace splatray
