/// The picture: linear float RGBA and, when asked for, auxiliary values per pixel.
#pragma once
#include <cstdint>
#include <vector>

#include "engine/image/view.h"

namespace splatray {

struct Image {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<vec4> rgba;     ///< top row first; linear radiance, not premultiplied by A = coverage
  std::vector<AovPixel> aov;  ///< empty unless Settings::aov
  /// Estimated error of each pixel, radiance: the root of the mean square over rgb; empty unless Settings::estimate_error or a
  /// Goal.
  std::vector<float> error{};
  /// Means of the first `part_share` of each pixel's samples; empty as `error` is. They and the others are independent pictures.
  std::vector<vec4> part{};
  float part_share = 0.5F;
  /// Base colours of the pixels, linear, 0 to 1, with coverage; empty unless Settings::albedo or asked for of a picture.
  std::vector<vec4> albedo{};
};

/// Bytes a pixel of the picture that is made with these settings, at most.
[[nodiscard]] inline std::uint64_t image_bytes(const Settings& settings) {
  return sizeof(vec4) + (settings.albedo ? sizeof(vec4) : 0) + (settings.aov ? sizeof(AovPixel) : 0) +
         (settings.estimate_error ? sizeof(vec4) + sizeof(float) : 0);
}

}  // namespace splatray
