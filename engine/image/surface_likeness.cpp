#include "engine/image/surface_likeness.h"

#include <cmath>
#include <limits>

#include "engine/base/vector_clones.h"
#include "shaders/display/denoise_layout.h"

namespace splatray {
namespace {

constexpr float DEPTH_SLACK = 1.0F;  ///< of the depth's change from pixel to pixel

/// The lists from a pixel on.
struct Surfaces {
  const std::uint32_t* object;
  const float *normal_x, *normal_y, *normal_z, *depth, *base_r, *base_g, *base_b;
};

SPLATRAY_VECTOR_CLONES void find_likeness(const Surfaces& here, const Surfaces& there, const float* slope_x,
                                          const float* slope_y, float dx, float dy, std::size_t count,
                                          float* __restrict like) {
  for (std::size_t k = 0; k < count; ++k) {
    const float cosine = here.normal_x[k] * there.normal_x[k] + here.normal_y[k] * there.normal_y[k] +
                         here.normal_z[k] * there.normal_z[k];
    float facing = cosine > 0.0F ? cosine : 0.0F;
    facing = facing < 1.0F ? facing : 1.0F;
    facing *= facing;
    facing *= facing;
    facing *= facing;
    facing *= facing;
    facing *= facing;  // to the power of 32
    const float step = here.depth[k] - there.depth[k];
    // Depths of parallel rays may lie on both sides of 0.
    const float depth = here.depth[k] < 0.0F ? -here.depth[k] : here.depth[k];
    const float expected =
        DEPTH_SLACK * (slope_x[k] * dx + slope_y[k] * dy) + 1e-4F * depth + std::numeric_limits<float>::min();
    const float r = here.base_r[k] - there.base_r[k], g = here.base_g[k] - there.base_g[k],
                b = here.base_b[k] - there.base_b[k];
    const float squares = here.base_r[k] * here.base_r[k] + there.base_r[k] * there.base_r[k] +
                          here.base_g[k] * here.base_g[k] + there.base_g[k] * there.base_g[k] +
                          here.base_b[k] * here.base_b[k] + there.base_b[k] * there.base_b[k];
    const float paint = (r * r + g * g + b * b) / (DENOISE_BASE_WIDTH * DENOISE_BASE_WIDTH *
                                                   (squares + DENOISE_BASE_DARK * DENOISE_BASE_DARK));
    const float of_one = here.object[k] == there.object[k] ? 1.0F : 0.0F;
    like[k] = of_one * facing * decay(-(step < 0.0F ? -step : step) / expected - paint);
  }
}

}  // namespace

SurfaceLikeness::SurfaceLikeness(const Image& image, std::span<const vec4> base) {
  const std::size_t width = image.width, pixels = image.rgba.size();
  for (std::vector<float>* list :
       {&normal_x_, &normal_y_, &normal_z_, &depth_, &base_r_, &base_g_, &base_b_, &slope_x_, &slope_y_})
    list->resize(pixels);
  object_.resize(pixels);
  const auto slope = [&](std::size_t i, std::size_t place, std::size_t length, std::size_t stride) {
    float least = INFINITY;
    if (place > 0) least = std::min(least, std::abs(image.aov[i - stride].z - image.aov[i].z));
    if (place + 1 < length) least = std::min(least, std::abs(image.aov[i + stride].z - image.aov[i].z));
    return std::isfinite(least) ? least : 0.0F;
  };
  PixelRows(width, image.height).for_pieces([&](std::size_t first, std::size_t count) {
    for (std::size_t i = first; i < first + count; ++i) {
      const AovPixel& pixel = image.aov[i];
      object_[i] = pixel.object;
      normal_x_[i] = pixel.normal.x;
      normal_y_[i] = pixel.normal.y;
      normal_z_[i] = pixel.normal.z;
      depth_[i] = pixel.z;
      base_r_[i] = base[i].x;
      base_g_[i] = base[i].y;
      base_b_[i] = base[i].z;
      slope_x_[i] = slope(i, i % width, width, 1);
      slope_y_[i] = slope(i, i / width, image.height, width);
    }
  });
}

bool SurfaceLikeness::any_surface(std::size_t first, std::size_t count) const {
  return std::any_of(object_.begin() + static_cast<std::ptrdiff_t>(first),
                     object_.begin() + static_cast<std::ptrdiff_t>(first + count),
                     [](std::uint32_t object) { return object != NO_OBJECT; });
}

void SurfaceLikeness::find(const Taps& taps, Piece& like) const {
  float* const from = like.data() + taps.first;
  if (taps.dx == 0 && taps.dy == 0) return void(std::fill_n(from, taps.count, 1.0F));
  const auto lists = [&](std::size_t pixel) {
    return Surfaces{&object_[pixel], &normal_x_[pixel], &normal_y_[pixel], &normal_z_[pixel],
                    &depth_[pixel],  &base_r_[pixel],   &base_g_[pixel],   &base_b_[pixel]};
  };
  find_likeness(lists(taps.center), lists(taps.tap), &slope_x_[taps.center], &slope_y_[taps.center],
                static_cast<float>(std::abs(taps.dx)), static_cast<float>(std::abs(taps.dy)), taps.count,
                from);
}

}  // namespace splatray
