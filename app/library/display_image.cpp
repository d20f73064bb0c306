#include "app/library/display_image.h"

#include <cmath>

namespace splatray {
namespace {

float encode_srgb(float linear) {
  return linear <= 0.0031308F ? 12.92F * linear : 1.055F * std::pow(linear, 1.0F / 2.4F) - 0.055F;
}

float shoulder(float x) {
  constexpr float KNEE = 0.8F, ROOM = 1.0F - KNEE;
  if (!(x > 0.0F)) return 0.0F;
  return x <= KNEE ? x : 1.0F - ROOM * std::exp((KNEE - x) / ROOM);
}

}  // namespace

vec3 display_value(vec3 radiance, double exposure_ev) {
  const auto factor = static_cast<float>(std::exp2(exposure_ev));
  const auto channel = [factor](float x) { return encode_srgb(shoulder(factor * x)); };
  return {channel(radiance.x), channel(radiance.y), channel(radiance.z)};
}

DisplayImage display_image(const Image& image, double exposure_ev) {
  DisplayImage display{image.width, image.height, {}};
  display.rgb.reserve(image.rgba.size());
  for (const vec4& pixel : image.rgba) display.rgb.push_back(display_value(vec3(pixel), exposure_ev));
  return display;
}

void quantise(DisplayImage& image) {
  for (vec3& pixel : image.rgb) pixel = glm::round(pixel * 255.0F) / 255.0F;
}

float decode_srgb(float encoded) {
  return encoded <= 0.04045F ? encoded / 12.92F : std::pow((encoded + 0.055F) / 1.055F, 2.4F);
}

}  // namespace splatray
