#include "app/view/thread/eye_dome.h"

#include <tbb/parallel_for.h>

#include <array>
#include <cmath>
#include <limits>

namespace splatray {
namespace {

constexpr float NO_LEVEL = std::numeric_limits<float>::infinity();
/// Darkening, as an exponent, by a step of one octave of distance to all neighbours, at USUAL_HEIGHT.
constexpr double DARKENING = 120.0;
constexpr double USUAL_HEIGHT = 720.0;  ///< pixels
constexpr double USUAL_PIXEL = 1.0e-3;  ///< of perspective pictures: a pixel's width over its distance

/// Logarithms of distances; in orthographic pictures, which have no eye to be near to, of steps as large in pixels.
std::vector<float> levels_of(std::span<const float> distance_world, const View& view) {
  std::vector<float> levels(distance_world.size());
  const double ortho = view.camera.ortho_height;
  const auto per_world = static_cast<float>(ortho > 0.0 ? USUAL_PIXEL * view.height / ortho : 0.0);
  tbb::parallel_for(std::size_t{0}, levels.size(), [&](std::size_t i) {
    const float distance = distance_world[i];
    const bool seen = distance > 0.0F && distance < NO_LEVEL;
    levels[i] = !seen ? NO_LEVEL : (ortho > 0.0 ? distance * per_world : std::log2(distance));
  });
  return levels;
}

}  // namespace

std::vector<float> eye_dome(std::span<const float> distance_world, const View& view, double strength) {
  const std::vector<float> level = levels_of(distance_world, view);
  const int width = static_cast<int>(view.width), height = static_cast<int>(view.height);
  const auto exponent = static_cast<float>(-strength * DARKENING * height / USUAL_HEIGHT / 8.0);
  std::vector<float> factor(level.size(), 1.0F);
  constexpr std::array<std::array<int, 2>, 8> AROUND = {
      {{-1, -1}, {0, -1}, {1, -1}, {-1, 0}, {1, 0}, {-1, 1}, {0, 1}, {1, 1}}};
  const auto at = [&](int x, int y) {
    return static_cast<std::size_t>(y) * view.width + static_cast<std::size_t>(x);
  };
  tbb::parallel_for(0, height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const float own = level[at(x, y)];
      if (own == NO_LEVEL) continue;
      float behind = 0.0F;
      for (const auto& [dx, dy] : AROUND) {
        const int beside_x = x + dx, beside_y = y + dy;
        if (beside_x < 0 || beside_y < 0 || beside_x >= width || beside_y >= height) continue;
        behind += std::max(0.0F, own - level[at(beside_x, beside_y)]);
      }
      factor[at(x, y)] = std::exp(exponent * behind);
    }
  });
  return factor;
}

}  // namespace splatray
