#include "app/library/palette.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/color_space.hpp>
#include <numbers>
#include <vector>

namespace splatray {
namespace {

constexpr float TURNS_APART = 0.618034F;  ///< golden section: hues of consecutive numbers lie far apart
/// Oklch lightness, chroma and hue of the two ends of heat_color; the middle is less colourful, to stay in sRGB.
constexpr float DARK = 0.27F, BRIGHT = 0.93F, CHROMA = 0.135F, CHROMA_DIP = 0.035F, HUE_DARK = 290.0F,
                HUE_BRIGHT = 105.0F;

/// Display-encoded rgb of Oklch (Ottosson 2020, "A perceptual color space for image processing"), clamped to
/// sRGB. `hue_deg` any.
glm::vec3 oklch(float lightness, float chroma, float hue_deg) {
  const float hue = glm::radians(hue_deg);
  const float a = chroma * std::cos(hue), b = chroma * std::sin(hue);
  const auto cube = [](float v) { return v * v * v; };
  const float l = cube(lightness + 0.3963377774F * a + 0.2158037573F * b);
  const float m = cube(lightness - 0.1055613458F * a - 0.0638541728F * b);
  const float s = cube(lightness - 0.0894841775F * a - 1.2914855480F * b);
  const glm::vec3 linear(4.0767416621F * l - 3.3077115913F * m + 0.2309699292F * s,
                         -1.2684380046F * l + 2.6097574011F * m - 0.3413193965F * s,
                         -0.0041960863F * l - 0.7034186147F * m + 1.7076147010F * s);
  return glm::convertLinearToSRGB(glm::clamp(linear, 0.0F, 1.0F));
}

}  // namespace

glm::vec3 number_color(std::uint32_t number) {
  const float turn = static_cast<float>(number % 4096U) * TURNS_APART;
  const float lightness = 0.62F + 0.08F * static_cast<float>(number % 4U);
  return oklch(lightness, 0.13F, 360.0F * (turn - std::floor(turn)));
}

glm::vec3 heat_color(float share) {
  static const std::vector<glm::vec3> COLORS = [] {
    std::vector<glm::vec3> colors;
    for (int i = 0; i < 256; ++i) {
      const float t = static_cast<float>(i) / 255.0F;
      const float dip = CHROMA_DIP * std::sin(std::numbers::pi_v<float> * t);
      colors.push_back(oklch(std::lerp(DARK, BRIGHT, t), CHROMA - dip, std::lerp(HUE_DARK, HUE_BRIGHT, t)));
    }
    return colors;
  }();
  if (!(share > 0.0F)) return COLORS.front();
  return COLORS[static_cast<std::size_t>(std::lround(255.0F * std::min(share, 1.0F)))];
}

glm::vec3 signed_color(float deviation) {
  constexpr float WHITE = 0.95F, END = 0.5F, MOST_CHROMA = 0.17F, RED = 27.0F, BLUE = 260.0F;
  const float size = std::min(std::abs(deviation), 1.0F);
  return oklch(std::lerp(WHITE, END, size), MOST_CHROMA * size, deviation < 0.0F ? BLUE : RED);
}

glm::vec3 land_color(float share) {
  static constexpr std::array STOPS = {glm::vec3(0.31F, 0.48F, 0.52F), glm::vec3(0.45F, 0.60F, 0.44F),
                                       glm::vec3(0.76F, 0.66F, 0.43F), glm::vec3(0.80F, 0.60F, 0.58F)};
  if (!(share > 0.0F)) return STOPS.front();
  const float at = std::min(share, 1.0F) * (STOPS.size() - 1);
  const auto first = std::min(static_cast<std::size_t>(at), STOPS.size() - 2);
  return glm::mix(STOPS[first], STOPS[first + 1], at - static_cast<float>(first));
}

}  // namespace splatray
