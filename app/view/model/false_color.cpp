#include "app/view/model/false_color.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

#include "app/library/palette.h"

namespace splatray {
namespace {

constexpr float MISS_GREY = 0.09F;       ///< display-encoded
constexpr double COUNTED_SHARE = 0.995;  ///< of the pixels whose counts fit the scale
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

/// What each mode is called, what its colours mean, and the value on its scale, if it has one.
struct ModeRow {
  const char* name;
  const char* legend;
  double (*value)(const AovPixel& pixel);
};
constexpr std::array<ModeRow, VIEW_MODE_COUNT> MODES = {{
    {"shaded", "", nullptr},
    {"normal", "normal: red x, green y, blue z, each from -1 to 1", nullptr},
    {"depth", "distance from the eye, world units", [](const AovPixel& p) { return double(p.z); }},
    {"object", "a colour for each object", nullptr},
    {"splat", "a colour for each splat", nullptr},
    {"facing", "front faces grey, back faces red", nullptr},
    {"tests", "splat tests of the pixel's ray", [](const AovPixel& p) { return double(p.tests); }},
    {"steps", "node words read by the pixel's ray", [](const AovPixel& p) { return double(p.steps); }},
}};

const ModeRow& row_of(ViewMode mode) { return MODES.at(static_cast<std::size_t>(mode)); }

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
    default:
      return heat_color(
          static_cast<float>((row_of(mode).value(pixel) - range.low) / (range.high - range.low)));
  }
}

/// Ends of an ascending pair that may be empty, infinite or equal.
ColorRange usable_range(double low, double high) {
  if (!std::isfinite(low) || !std::isfinite(high)) return {};
  return {low, high > low ? high : low + std::max(1.0, std::abs(low)) * 1e-6};
}

}  // namespace

const char* view_mode_name(ViewMode mode) { return row_of(mode).name; }
const char* view_mode_legend(ViewMode mode) { return row_of(mode).legend; }
bool has_scale(ViewMode mode) { return row_of(mode).value != nullptr; }

ColorRange color_range(std::span<const AovPixel> pixels, ViewMode mode) {
  const auto value = row_of(mode).value;
  if (value == nullptr || pixels.empty()) return {};
  if (!counts(mode)) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const AovPixel& pixel : pixels) {
      if (pixel.object == NO_OBJECT) continue;
      low = std::min(low, value(pixel));
      high = std::max(high, value(pixel));
    }
    return usable_range(low, high);
  }
  std::vector<double> values;
  values.reserve(pixels.size());
  for (const AovPixel& pixel : pixels) values.push_back(value(pixel));
  const auto nth = values.begin() + std::ptrdiff_t(COUNTED_SHARE * double(values.size() - 1));
  std::nth_element(values.begin(), nth, values.end());
  return {0.0, std::max(1.0, *nth)};
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
