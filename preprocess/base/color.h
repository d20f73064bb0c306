/// From the colours of files to the linear colours of the scene.
#pragma once
#include <cmath>

namespace splatray {

/// Linear intensity of an sRGB-encoded value, both 0..1 (IEC 61966-2-1).
[[nodiscard]] inline float srgb_to_linear(float encoded) {
  return encoded <= 0.04045F ? encoded / 12.92F : std::pow((encoded + 0.055F) / 1.055F, 2.4F);
}

}  // namespace splatray
