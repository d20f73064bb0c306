#include "app/library/sheet/ink.h"

#include <algorithm>
#include <cmath>

namespace splatray {
namespace {

constexpr double LINE_MM = 0.18;        ///< width of a line on paper
constexpr double DEPTH_PIXELS = 6.0;    ///< a step of depth that is a line, pixels
constexpr float CREASE_COSINE = 0.77F;  ///< of 40 degrees
constexpr float CREASE_INK = 0.6F;
/// Steepest surface, as the cosine towards the paper, whose slope is followed.
constexpr float STEEPEST = 0.1F;

/// How much of a line is between a pixel and the next one at (dx, dy).
class Edges {
 public:
  Edges(const Sheet& sheet, const Image& image)
      : image_(image),
        right_(sheet.right),
        top_(sheet.top),
        toward_(sheet.toward),
        pixel_(static_cast<float>(sheet.pixel_world)) {}

  [[nodiscard]] float between(std::size_t a, std::size_t b, float dx, float dy) const {
    const AovPixel &first = image_.aov[a], &second = image_.aov[b];
    const bool hit = first.object != NO_OBJECT, hit_too = second.object != NO_OBJECT;
    if (hit != hit_too) return 1.0F;
    if (!hit) return 0.0F;
    if (first.object != second.object) return 1.0F;
    const float step = second.z - first.z;
    const float off = std::min(std::abs(step - slope(first, dx, dy)), std::abs(step - slope(second, dx, dy)));
    if (off > static_cast<float>(DEPTH_PIXELS) * pixel_) return 1.0F;
    return glm::dot(first.normal, second.normal) < CREASE_COSINE ? CREASE_INK : 0.0F;
  }

 private:
  /// What the depth of the surface changes by over a step on the paper.
  [[nodiscard]] float slope(const AovPixel& at, float dx, float dy) const {
    const float facing = glm::dot(at.normal, toward_);
    const float across = glm::dot(at.normal, right_) * dx + glm::dot(at.normal, top_) * dy;
    return across / std::copysign(std::max(std::abs(facing), STEEPEST), facing) * pixel_;
  }

  const Image& image_;
  vec3 right_, top_, toward_;
  float pixel_;
};

}  // namespace

void draw_ink(const Sheet& sheet, Image& image) {
  const Edges edges(sheet, image);
  const std::size_t width = image.width, height = image.height;
  std::vector<float> ink(image.rgba.size(), 0.0F);
  const auto mark = [&](std::size_t a, std::size_t b, float amount) {
    // On the nearer side: what is seen before the other has the outline.
    const bool near_a = !(image.aov[a].z > image.aov[b].z);
    float& most = ink[near_a ? a : b];
    most = std::max(most, amount);
  };
  for (std::size_t y = 0; y < height; ++y)
    for (std::size_t x = 0; x < width; ++x) {
      const std::size_t at = y * width + x;
      if (x + 1 < width) mark(at, at + 1, edges.between(at, at + 1, 1.0F, 0.0F));
      if (y + 1 < height) mark(at, at + width, edges.between(at, at + width, 0.0F, -1.0F));
    }
  const auto reach = static_cast<std::ptrdiff_t>(std::lround((LINE_MM / sheet.pixel_mm() - 1.0) / 2.0));
  const auto widest = [&](std::size_t x, std::size_t y) {
    float most = ink[y * width + x];
    for (std::ptrdiff_t j = -reach; j <= reach; ++j)
      for (std::ptrdiff_t i = -reach; i <= reach; ++i) {
        const std::ptrdiff_t column = static_cast<std::ptrdiff_t>(x) + i,
                             row = static_cast<std::ptrdiff_t>(y) + j;
        if (column < 0 || row < 0 || column >= static_cast<std::ptrdiff_t>(width) ||
            row >= static_cast<std::ptrdiff_t>(height))
          continue;
        most = std::max(most, ink[static_cast<std::size_t>(row) * width + static_cast<std::size_t>(column)]);
      }
    return most;
  };
  for (std::size_t y = 0; y < height; ++y)
    for (std::size_t x = 0; x < width; ++x) {
      const float amount = reach > 0 ? widest(x, y) : ink[y * width + x];
      vec4& pixel = image.rgba[y * width + x];
      pixel = vec4(0.0F, 0.0F, 0.0F, amount) + (1.0F - amount) * pixel;
    }
}

}  // namespace splatray
