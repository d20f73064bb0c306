/// Pictures as a display shows them.
#pragma once
#include <cstdint>
#include <vector>

#include "engine/image/image.h"

namespace splatray {

/// Display-encoded picture, 0..1 per channel, top row first.
struct DisplayImage {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<vec3> rgb;
};

/// Linear radiance to display value: factor 2^exposure_ev, a soft shoulder (identity up to 0.8, then 1 - 0.2
/// exp(-(x - 0.8) / 0.2), which joins with equal slope and reaches 1 at infinity; NaN and negative values
/// become 0), then the sRGB transfer function.
[[nodiscard]] vec3 display_value(vec3 radiance, double exposure_ev);
[[nodiscard]] DisplayImage display_image(const Image& image, double exposure_ev);
/// Rounds each channel to the 8 bits a PNG stores.
void quantise(DisplayImage& image);

}  // namespace splatray
