#include "engine/image/fireflies.h"

#include <algorithm>
#include <cassert>

#include "shaders/display/denoise_layout.h"

namespace splatray {
namespace {

/// The greatest of each value and its eight neighbours.
std::vector<float> greatest_around(const std::vector<float>& values, std::size_t width) {
  const std::size_t height = values.size() / width;
  std::vector<float> rows = values, greatest(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i % width > 0) rows[i] = std::max(rows[i], values[i - 1]);
    if (i % width + 1 < width) rows[i] = std::max(rows[i], values[i + 1]);
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    greatest[i] = rows[i];
    if (i / width > 0) greatest[i] = std::max(greatest[i], rows[i - width]);
    if (i / width + 1 < height) greatest[i] = std::max(greatest[i], rows[i + width]);
  }
  return greatest;
}

}  // namespace

void limit_fireflies(Halves& halves, std::uint32_t width) {
  std::array<std::vector<float>, 2> bright;
  for (std::size_t half = 0; half < 2; ++half)
    for (const vec3& color : halves[half])
      bright[half].push_back(glm::dot(color, vec3(0.2126F, 0.7152F, 0.0722F)));
  for (std::size_t half = 0; half < 2; ++half) {
    const std::vector<float> most = greatest_around(bright[1 - half], width);
    for (std::size_t i = 0; i < most.size(); ++i)
      if (bright[half][i] > DENOISE_SPARK * most[i])
        halves[half][i] *= DENOISE_SPARK * most[i] / bright[half][i];
  }
}

Image without_fireflies(Image image) {
  assert(image.part.size() == image.rgba.size());
  const float share = image.part_share;
  Halves halves;
  for (std::size_t i = 0; i < image.rgba.size(); ++i) {
    halves[0].emplace_back(image.part[i]);
    halves[1].emplace_back((vec3(image.rgba[i]) - share * halves[0][i]) / (1.0F - share));
  }
  const Halves before = halves;
  limit_fireflies(halves, image.width);
  for (std::size_t i = 0; i < image.rgba.size(); ++i) {
    if (halves[0][i] == before[0][i] && halves[1][i] == before[1][i]) continue;
    image.rgba[i] = vec4(glm::mix(halves[1][i], halves[0][i], share), image.rgba[i].w);
  }
  return image;
}

}  // namespace splatray
