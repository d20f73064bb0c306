#include "app/view/display/eye_dome.h"

#include <tbb/parallel_for.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace splatray {
namespace {

namespace glsl {
#include "shaders/lang/glsl_as_cpp.h"
using std::log2;
#include "shaders/display/eye_dome.glsl"
}  // namespace glsl

/// Darkening, as an exponent, by a step of one octave of distance to all neighbours, at USUAL_HEIGHT.
constexpr double DARKENING = 120.0;
constexpr double USUAL_HEIGHT = 720.0;  ///< pixels
constexpr double USUAL_PIXEL = 1.0e-3;  ///< of perspective pictures: a pixel's width over its distance

}  // namespace

DomeScale dome_scale(const View& view, double strength) {
  const double ortho = view.camera.ortho_height;
  return {static_cast<float>(-strength * DARKENING * static_cast<int>(view.height) / USUAL_HEIGHT / 8.0),
          static_cast<float>(ortho > 0.0 ? USUAL_PIXEL * view.height / ortho : 0.0)};
}

std::vector<float> eye_dome(std::span<const float> distance_world, const View& view, double strength) {
  const DomeScale scale = dome_scale(view, strength);
  std::vector<float> level(distance_world.size());
  tbb::parallel_for(std::size_t{0}, level.size(),
                    [&](std::size_t i) { level[i] = glsl::dome_level(distance_world[i], scale.per_world); });
  const int width = static_cast<int>(view.width), height = static_cast<int>(view.height);
  std::vector<float> factor(level.size(), 1.0F);
  constexpr std::array<std::array<int, 2>, 8> AROUND = {
      {{-1, -1}, {0, -1}, {1, -1}, {-1, 0}, {1, 0}, {-1, 1}, {0, 1}, {1, 1}}};
  const auto at = [&](int x, int y) {
    return static_cast<std::size_t>(y) * view.width + static_cast<std::size_t>(x);
  };
  tbb::parallel_for(0, height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const float own = level[at(x, y)];
      if (std::isinf(own)) continue;
      float behind = 0.0F;
      for (const auto& [dx, dy] : AROUND) {
        const int beside_x = x + dx, beside_y = y + dy;
        if (beside_x < 0 || beside_y < 0 || beside_x >= width || beside_y >= height) continue;
        behind += glsl::dome_step(own, level[at(beside_x, beside_y)]);
      }
      factor[at(x, y)] = glsl::dome_factor(scale.exponent, behind);
    }
  });
  return factor;
}

}  // namespace splatray
