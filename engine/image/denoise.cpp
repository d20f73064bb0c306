#include "engine/image/denoise.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <thread>
#include <vector>

namespace splatray {
namespace {

constexpr int PASSES = 5;            ///< the last one's taps lie 16 pixels apart
constexpr float BASE_LEAST = 0.05F;  ///< light of darker surfaces is that of such ones
constexpr float NORMAL_POWER = 64.0F;
constexpr float DEPTH_SLACK = 1.0F;   ///< of the depth's change from pixel to pixel
constexpr float SPARK_NOISE = 0.25F;  ///< standard error of a pixel that one sample made bright, of its light
constexpr float NOISE_WIDTH = 4.0F;   ///< standard errors by which light may differ
constexpr float KERNEL[] = {0.375F, 0.25F, 0.0625F};  ///< B3 spline

float luminance(const vec3& color) { return glm::dot(color, vec3(0.2126F, 0.7152F, 0.0722F)); }

/// Light of each pixel, over its base colour, and its variance.
struct Light {
  std::vector<vec3> color;
  std::vector<float> variance;
};

class Filter {
 public:
  Filter(const Image& image, std::span<const vec4> base)
      : image_(image),
        base_(base),
        width_(static_cast<int>(image.width)),
        height_(static_cast<int>(image.height)),
        slopes_(image.rgba.size()) {
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x) slopes_[at(x, y)] = slope(x, y);
  }

  Image run() const {
    Light light = spread_variance(without_sparks(taken_apart()));
    for (int pass = 0; pass < PASSES; ++pass) light = filtered(light, 1 << pass);
    Image result = image_;
    for (std::size_t i = 0; i < result.rgba.size(); ++i)
      if (is_surface(i)) result.rgba[i] = vec4(light.color[i] * base_of(i), result.rgba[i].w);
    return result;
  }

 private:
  [[nodiscard]] std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }
  [[nodiscard]] bool is_surface(std::size_t i) const { return image_.aov[i].object != NO_OBJECT; }
  [[nodiscard]] vec3 base_of(std::size_t i) const { return glm::max(vec3(base_[i]), vec3(BASE_LEAST)); }

  /// Calls work(row) for all rows, on all cores; what it writes is of its row alone.
  template <class Work>
  void for_rows(const Work& work) const {
    std::atomic<int> next{0};
    const auto take = [&] {
      for (int y = next++; y < height_; y = next++) work(y);
    };
    std::vector<std::jthread> others;
    for (unsigned i = 1; i < std::thread::hardware_concurrency(); ++i) others.emplace_back(take);
    take();
  }

  /// The least change of depth towards a neighbour, per pixel: at edges that of the pixel's own surface.
  [[nodiscard]] vec2 slope(int x, int y) const {
    const auto least = [&](int dx, int dy) {
      const float here = image_.aov[at(x, y)].z;
      float change = INFINITY;
      for (const int side : {-1, 1}) {
        const int u = x + side * dx, v = y + side * dy;
        if (u < 0 || v < 0 || u >= width_ || v >= height_) continue;
        const float step = std::abs(image_.aov[at(u, v)].z - here);
        if (step < change) change = step;
      }
      return std::isfinite(change) ? change : 0.0F;
    };
    return {least(1, 0), least(0, 1)};
  }

  [[nodiscard]] Light taken_apart() const {
    Light light{std::vector<vec3>(image_.rgba.size()), std::vector<float>(image_.rgba.size())};
    for (std::size_t i = 0; i < image_.rgba.size(); ++i) {
      light.color[i] = vec3(image_.rgba[i]) / base_of(i);
      const float error = image_.error[i] / luminance(base_of(i));
      light.variance[i] = error * error;
    }
    return light;
  }

  /// How much of one pixel's surface another one is.
  [[nodiscard]] float likeness(std::size_t a, std::size_t b, int dx, int dy) const {
    if (image_.aov[a].object != image_.aov[b].object) return 0.0F;
    const float facing = std::max(glm::dot(image_.aov[a].normal, image_.aov[b].normal), 0.0F);
    const float expected = slopes_[a].x * float(std::abs(dx)) + slopes_[a].y * float(std::abs(dy));
    const float apart = std::abs(image_.aov[a].z - image_.aov[b].z);
    return std::pow(facing, NORMAL_POWER) *
           std::exp(-apart / (DEPTH_SLACK * expected + 1e-4F * image_.aov[a].z));
  }

  /// Calls take(pixel, its distance in x and y) for the pixels of a square around one that lie in the picture.
  template <class Take>
  void around(int x, int y, int reach, int step, const Take& take) const {
    for (int j = -reach; j <= reach; ++j)
      for (int i = -reach; i <= reach; ++i) {
        const int u = x + i * step, v = y + j * step;
        if (u >= 0 && v >= 0 && u < width_ && v < height_) take(at(u, v), i, j);
      }
  }

  /// Pixels brighter than all eight around them have found light by rare chance: they get that of the brightest of these.
  [[nodiscard]] Light without_sparks(const Light& light) const {
    Light result = light;
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x) {
        const std::size_t center = at(x, y);
        float most = 0.0F;
        around(x, y, 1, 1, [&](std::size_t tap, int, int) {
          if (tap != center) most = std::max(most, luminance(light.color[tap]));
        });
        const float bright = luminance(light.color[center]);
        const bool is_spark = bright > most && std::sqrt(light.variance[center]) > SPARK_NOISE * bright;
        if (!is_surface(center) || !is_spark) continue;
        result.color[center] *= most / bright;
        result.variance[center] *= most * most / (bright * bright);
      }
    return result;
  }

  /// Two halves of the samples say little about one pixel's noise; the mean over 7 x 7 of the same surface estimates it.
  [[nodiscard]] Light spread_variance(Light light) const {
    std::vector<float> spread(light.variance.size(), 0.0F);
    for_rows([&](int y) {
      for (int x = 0; x < width_; ++x) {
        const std::size_t center = at(x, y);
        if (!is_surface(center)) continue;
        float sum = 0.0F, weights = 0.0F;
        around(x, y, 3, 1, [&](std::size_t tap, int dx, int dy) {
          const float weight = likeness(center, tap, dx, dy);
          sum += weight * light.variance[tap];
          weights += weight;
        });
        spread[center] = weights > 0.0F ? sum / weights : light.variance[center];
      }
    });
    light.variance = std::move(spread);
    return light;
  }

  [[nodiscard]] Light filtered(const Light& light, int step) const {
    Light result = light;
    for_rows([&](int y) {
      for (int x = 0; x < width_; ++x) {
        const std::size_t center = at(x, y);
        if (!is_surface(center)) continue;
        const float bright = luminance(light.color[center]);
        const float width = NOISE_WIDTH * std::sqrt(light.variance[center]) + 1e-6F;
        vec3 sum(0.0F);
        float variance = 0.0F, weights = 0.0F;
        around(x, y, 2, step, [&](std::size_t tap, int dx, int dy) {
          float weight = KERNEL[std::abs(dx)] * KERNEL[std::abs(dy)];
          if (tap != center)
            weight *= likeness(center, tap, dx * step, dy * step) *
                      std::exp(-std::abs(luminance(light.color[tap]) - bright) / width);
          sum += weight * light.color[tap];
          variance += weight * weight * light.variance[tap];
          weights += weight;
        });
        result.color[center] = sum / weights;
        result.variance[center] = variance / (weights * weights);
      }
    });
    return result;
  }

  const Image& image_;
  const std::span<const vec4> base_;
  const int width_, height_;
  std::vector<vec2> slopes_;  ///< of depth, along x and y
};

}  // namespace

Image denoised(const Image& image, std::span<const vec4> base) {
  assert(image.aov.size() == image.rgba.size() && image.error.size() == image.rgba.size() &&
         base.size() == image.rgba.size());
  return Filter(image, base).run();
}

}  // namespace splatray
