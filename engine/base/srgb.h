/// sRGB's transfer function (IEC 61966-2-1), both ways; values 0..1.
#pragma once
#include <cmath>
#include <glm/glm.hpp>

namespace splatray {

/// Linear intensity of an sRGB-encoded value.
[[nodiscard]] inline float srgb_to_linear(float encoded) {
  return encoded <= 0.04045F ? encoded / 12.92F : std::pow((encoded + 0.055F) / 1.055F, 2.4F);
}

/// sRGB-encoded value of a linear intensity.
[[nodiscard]] inline float linear_to_srgb(float linear) {
  return linear <= 0.0031308F ? 12.92F * linear : 1.055F * std::pow(linear, 1.0F / 2.4F) - 0.055F;
}
[[nodiscard]] inline glm::vec3 linear_to_srgb(const glm::vec3& linear) {
  return {linear_to_srgb(linear.x), linear_to_srgb(linear.y), linear_to_srgb(linear.z)};
}

}  // namespace splatray
