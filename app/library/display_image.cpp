#include "app/library/display_image.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>

#include "engine/base/all_cores.h"
#include "engine/base/srgb.h"

namespace splatray {
namespace {

namespace glsl {
#include "shaders/lang/glsl_as_cpp.h"
using glm::log2;
using glm::mat3;
using glm::pow;
#include "shaders/display/tone.glsl"
}  // namespace glsl

float shoulder(float x) {
  constexpr float KNEE = 0.8F, ROOM = 1.0F - KNEE;
  return x <= KNEE ? x : 1.0F - ROOM * std::exp((KNEE - x) / ROOM);
}

}  // namespace

vec3 toned(vec3 radiance, const Display& display) {
  const auto factor = static_cast<float>(std::exp2(display.exposure_ev));
  const vec3 color = glsl::tone_usable(factor * radiance);
  switch (display.tone) {
    case Tone::neutral:
      return glsl::tone_neutral(color);
    case Tone::agx:
      return glsl::tone_agx(color);
    case Tone::none:
      return glm::min(color, vec3(1.0F));
    default:
      return {shoulder(color.x), shoulder(color.y), shoulder(color.z)};
  }
}

vec3 display_value(vec3 radiance, const Display& display) { return linear_to_srgb(toned(radiance, display)); }

DisplayImage display_image(const Image& image, const Display& display) {
  DisplayImage shown{image.width, image.height, std::vector<vec3>(image.rgba.size())};
  if (display.transparent) shown.alpha.resize(image.rgba.size());
  on_all_cores(image.height, [&](std::size_t row) {
    for (std::size_t i = row * image.width; i < (row + 1) * image.width; ++i) {
      const vec4& pixel = image.rgba[i];
      const float alpha = display.transparent ? std::clamp(pixel.w, 0.0F, 1.0F) : 1.0F;
      shown.rgb[i] = alpha > 0.0F ? display_value(vec3(pixel) / alpha, display) : vec3(0.0F);
      if (display.transparent) shown.alpha[i] = alpha;
    }
  });
  return shown;
}

double automatic_exposure_ev(const Image& image) {
  constexpr double MIDDLE = 0.25, BRIGHT = 0.65, DARK = 0.15;
  for (const float least_coverage : {0.5F, 0.0F}) {
    std::vector<double> stops;
    for (const vec4& pixel : image.rgba) {
      const double bright = (double(pixel.x) + double(pixel.y) + double(pixel.z)) / 3.0;
      if (pixel.w < least_coverage || !(bright > 1e-9) || !std::isfinite(bright)) continue;
      stops.push_back(std::log2(bright));
    }
    if (stops.empty()) continue;
    std::sort(stops.begin(), stops.end());
    const auto at = [&stops](double share) { return stops[std::size_t(share * double(stops.size() - 1))]; };
    const double mean = std::accumulate(stops.begin(), stops.end(), 0.0) / double(stops.size());
    return std::min(std::log2(MIDDLE) - mean,
                    std::max(std::log2(BRIGHT) - at(0.95), std::log2(DARK) - at(0.5)));
  }
  return 0.0;
}

void quantise(DisplayImage& image) {
  for (vec3& pixel : image.rgb) pixel = glm::round(pixel * 255.0F) / 255.0F;
}

}  // namespace splatray
