#include "app/library/display_image.h"

#include <cmath>

#include "engine/base/srgb.h"

namespace splatray {
namespace {

float shoulder(float x) {
  constexpr float KNEE = 0.8F, ROOM = 1.0F - KNEE;
  if (!(x > 0.0F)) return 0.0F;
  return x <= KNEE ? x : 1.0F - ROOM * std::exp((KNEE - x) / ROOM);
}

}  // namespace

vec3 display_value(vec3 radiance, double exposure_ev) {
  const auto factor = static_cast<float>(std::exp2(exposure_ev));
  const auto channel = [factor](float x) { return linear_to_srgb(shoulder(factor * x)); };
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

}  // namespace splatray
