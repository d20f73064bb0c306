#include "app/view/model/false_color.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <glm/gtc/color_space.hpp>
#include <limits>
#include <numbers>

namespace splatray {
namespace {

constexpr float MISS_GREY = 0.09F;        ///< display-encoded
constexpr double COUNTED_SHARE = 0.995;   ///< of the pixels whose counts fit the scale
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

/// A colour of its own for each number; consecutive ones differ in hue and lightness.
glm::vec3 number_color(std::uint32_t number) {
  const float turn = static_cast<float>(number % 4096U) * TURNS_APART;
  const float lightness = 0.62F + 0.08F * static_cast<float>(number % 4U);
  return oklch(lightness, 0.13F, 360.0F * (turn - std::floor(turn)));
}

/// number_color of a few hundred colours made once, for numbers that are hashes.
glm::vec3 hash_color(std::uint32_t hash) {
  static const std::vector<glm::vec3> COLORS = [] {
    std::vector<glm::vec3> colors;
    for (std::uint32_t i = 0; i < 1024; ++i) colors.push_back(number_color(i));
    return colors;
  }();
  return COLORS[(hash ^ hash >> 10 ^ hash >> 20) % COLORS.size()];
}

glm::vec3 face_color(const AovPixel& pixel) {
  static const glm::vec3 TO_LIGHT = glm::normalize(glm::vec3(0.4F, 0.6F, 0.7F));
  const float light = 0.25F + 0.6F * std::abs(glm::dot(pixel.normal, TO_LIGHT));
  return (pixel.splat & 1U) != 0 ? glm::vec3(light) : light * glm::vec3(1.0F, 0.22F, 0.18F);
}

double value_of(const AovPixel& pixel, ViewMode mode) {
  switch (mode) {
    case ViewMode::depth:
      return pixel.z;
    case ViewMode::tests:
      return pixel.tests;
    case ViewMode::steps:
      return pixel.steps;
    default:
      return 0.0;
  }
}

bool counts(ViewMode mode) { return mode == ViewMode::tests || mode == ViewMode::steps; }

glm::vec3 pixel_color(const AovPixel& pixel, ViewMode mode, const ColorRange& range) {
  const bool missed = pixel.object == NO_OBJECT;
  if (missed && !counts(mode)) return glm::vec3(MISS_GREY);
  switch (mode) {
    case ViewMode::normal:
      return 0.5F + 0.5F * pixel.normal;
    case ViewMode::object:
      return hash_color(pixel.object % 1024U);
    case ViewMode::splat:
      return hash_color(pixel.splat >> 1U);
    case ViewMode::facing:
      return face_color(pixel);
    case ViewMode::depth:
    case ViewMode::tests:
    case ViewMode::steps:
    case ViewMode::shaded:
      break;
  }
  return heat_color(static_cast<float>((value_of(pixel, mode) - range.low) / (range.high - range.low)));
}

/// Ends of an ascending pair that may be empty, infinite or equal.
ColorRange usable_range(double low, double high) {
  if (!std::isfinite(low) || !std::isfinite(high)) return {};
  return {low, high > low ? high : low + std::max(1.0, std::abs(low)) * 1e-6};
}

}  // namespace

const char* view_mode_name(ViewMode mode) {
  static constexpr std::array<const char*, VIEW_MODE_COUNT> NAMES = {"shaded", "normal", "depth", "object",
                                                                     "splat",  "facing", "tests", "steps"};
  return NAMES[static_cast<std::size_t>(mode)];
}

ColorRange color_range(std::span<const AovPixel> pixels, ViewMode mode) {
  if (mode == ViewMode::depth) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const AovPixel& pixel : pixels) {
      if (pixel.object == NO_OBJECT) continue;
      low = std::min(low, double(pixel.z));
      high = std::max(high, double(pixel.z));
    }
    return usable_range(low, high);
  }
  if (!counts(mode) || pixels.empty()) return {};
  std::vector<double> values;
  values.reserve(pixels.size());
  for (const AovPixel& pixel : pixels) values.push_back(value_of(pixel, mode));
  const auto nth = values.begin() + std::ptrdiff_t(COUNTED_SHARE * double(values.size() - 1));
  std::nth_element(values.begin(), nth, values.end());
  return {0.0, std::max(1.0, *nth)};
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

std::vector<std::uint8_t> false_color(std::span<const AovPixel> pixels, ViewMode mode,
                                      const ColorRange& range) {
  assert(mode != ViewMode::shaded && range.high > range.low);
  std::vector<std::uint8_t> rgba;
  rgba.reserve(4 * pixels.size());
  for (const AovPixel& pixel : pixels) {
    const glm::vec3 color = glm::clamp(pixel_color(pixel, mode, range), 0.0F, 1.0F);
    for (int c = 0; c < 3; ++c) rgba.push_back(static_cast<std::uint8_t>(std::lround(255.0F * color[c])));
    rgba.push_back(255);
  }
  return rgba;
}

}  // namespace splatray
