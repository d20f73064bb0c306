/// How far a picture is from what more samples would make of it.
#pragma once
#include <span>
#include <vector>

#include "engine/image/image.h"

namespace splatray {

/// The root of the mean square over rgb of each pixel's difference.
[[nodiscard]] std::vector<float> pixel_errors(std::span<const vec4> a, std::span<const vec4> b);

/// Gives an image of `samples` samples a pixel its part, the means of the first `part_samples` of them, and its estimated error:
/// by how much the others changed these, scaled to what that is where the part is one half. Infinite where the part is all.
void estimate_errors(std::vector<vec4> part, double part_samples, double samples, Image& image);

/// Mean radiance of rgb over all pixels.
[[nodiscard]] double mean_radiance(std::span<const vec4> pixels);

/// The root of the mean square of a picture's Image::error, over its mean radiance; 0 of a black one.
[[nodiscard]] double relative_error(const Image& image);

}  // namespace splatray
