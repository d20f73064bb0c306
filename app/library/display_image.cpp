#include "app/library/display_image.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/base/all_cores.h"
#include "engine/base/srgb.h"

namespace splatray {
namespace {

float shoulder(float x) {
  constexpr float KNEE = 0.8F, ROOM = 1.0F - KNEE;
  return x <= KNEE ? x : 1.0F - ROOM * std::exp((KNEE - x) / ROOM);
}

/// Khronos PBR Neutral's published formula and constants.
vec3 neutral(vec3 color) {
  constexpr float START = 0.8F - 0.04F, DESATURATION = 0.15F;
  const float least = std::min({color.x, color.y, color.z});
  color -= least < 0.08F ? least - 6.25F * least * least : 0.04F;
  const float peak = std::max({color.x, color.y, color.z});
  if (peak < START) return color;
  constexpr float ROOM = 1.0F - START;
  const float lowered = 1.0F - ROOM * ROOM / (peak + ROOM - START);
  const float faded = 1.0F - 1.0F / (DESATURATION * (peak - lowered) + 1.0F);
  return glm::mix(color * (lowered / peak), vec3(lowered), faded);
}

/// AgX's matrices and range of stops, its curve as a polynomial.
vec3 agx(const vec3& color) {
  const glm::mat3 inset(0.842479062253094F, 0.0423282422610123F, 0.0423756549057051F, 0.0784335999999992F,
                        0.878468636469772F, 0.0784336F, 0.0792237451477643F, 0.0791661274605434F,
                        0.879142973793104F);
  const glm::mat3 outset(1.19687900512017F, -0.0528968517574562F, -0.0529716355144438F, -0.0980208811401368F,
                         1.15190312990417F, -0.0980434501171241F, -0.0990297440797205F, -0.0989611768448433F,
                         1.15107367264116F);
  constexpr float LEAST_EV = -12.47393F, MOST_EV = 4.026069F;
  const vec3 inside = glm::max(inset * color, vec3(1e-10F));
  const vec3 x = (glm::clamp(glm::log2(inside), LEAST_EV, MOST_EV) - LEAST_EV) / (MOST_EV - LEAST_EV);
  const vec3 x2 = x * x, x4 = x2 * x2;
  const vec3 curve = 15.5F * x4 * x2 - 40.14F * x4 * x + 31.96F * x4 - 6.868F * x2 * x + 0.4298F * x2 +
                     0.1191F * x - 0.00232F;
  return glm::pow(glm::max(outset * curve, vec3(0.0F)), vec3(2.2F));
}

/// What is not a number, and what is negative, is black; infinity the largest number whose square is one.
float usable(float x) { return x > 0.0F ? std::min(x, 1e18F) : 0.0F; }

}  // namespace

vec3 toned(vec3 radiance, const Display& display) {
  const auto factor = static_cast<float>(std::exp2(display.exposure_ev));
  const vec3 color(usable(factor * radiance.x), usable(factor * radiance.y), usable(factor * radiance.z));
  switch (display.tone) {
    case Tone::neutral:
      return glm::clamp(neutral(color), vec3(0.0F), vec3(1.0F));
    case Tone::agx:
      return glm::clamp(agx(color), vec3(0.0F), vec3(1.0F));
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
