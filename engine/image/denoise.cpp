#include "engine/image/denoise.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <cmath>
#include <thread>
#include <utility>
#include <vector>

#include "engine/image/sparks.h"

namespace splatray {
namespace {

constexpr int PASSES = 5;              ///< the last one's taps lie 16 pixels apart
constexpr float BASE_LEAST = 0.05F;    ///< light of darker surfaces is that of such ones
constexpr float DEPTH_SLACK = 1.0F;    ///< of the depth's change from pixel to pixel
constexpr float NOISE_WIDTH = 1.5F;    ///< standard errors of a difference by which light may differ
constexpr float OWN_WIDTH = 6.0F;      ///< the same in the half that is filtered, whose own outliers stay out
constexpr float RIM_LIKENESS = 0.01F;  ///< less, and a neighbour is of another surface
constexpr float KERNEL[] = {0.375F, 0.25F, 0.0625F};  ///< B3 spline
constexpr float SMALL_KERNEL[] = {0.5F, 0.25F};       ///< of the guide

float luminance(const vec3& color) { return glm::dot(color, vec3(0.2126F, 0.7152F, 0.0722F)); }

/// Light of each pixel over its base colour, in two pictures of independent samples, and the variance of one of them.
struct Light {
  Halves halves;
  std::vector<float> variance;
};

/// By what pixels are compared: the brightness of both halves, a little smoothed, and its variance.
struct Guide {
  std::array<std::vector<float>, 2> bright;
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
    Light light = taken_apart();
    limit_sparks(light.halves, image_.width);
    const Image unfiltered = joined(light);
    light = with_variance(std::move(light));
    for (int pass = 0; pass < PASSES; ++pass) light = filtered(light, guide_of(light), 1 << pass);
    return with_limited_rims(joined(light), unfiltered);
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
    const std::size_t pixels = image_.rgba.size();
    Light light{{std::vector<vec3>(pixels), std::vector<vec3>(pixels)}, {}};
    const float share = image_.part_share;
    for (std::size_t i = 0; i < pixels; ++i) {
      const vec3 all = vec3(image_.rgba[i]) / base_of(i), part = vec3(image_.part[i]) / base_of(i);
      light.halves[0][i] = part;
      light.halves[1][i] = (all - share * part) / (1.0F - share);
    }
    return light;
  }

  /// The image with this light.
  [[nodiscard]] Image joined(const Light& light) const {
    Image result = image_;
    for (std::size_t i = 0; i < result.rgba.size(); ++i) {
      const vec3 both = glm::mix(light.halves[1][i], light.halves[0][i], image_.part_share);
      if (is_surface(i)) result.rgba[i] = vec4(both * base_of(i), result.rgba[i].w);
    }
    return result;
  }

  /// How much of one pixel's surface another one is.
  [[nodiscard]] float likeness(std::size_t a, std::size_t b, int dx, int dy) const {
    if (image_.aov[a].object != image_.aov[b].object) return 0.0F;
    float facing = std::max(glm::dot(image_.aov[a].normal, image_.aov[b].normal), 0.0F);
    for (int doubled = 0; doubled < 5; ++doubled) facing *= facing;  // to the power of 32
    const float expected = slopes_[a].x * float(std::abs(dx)) + slopes_[a].y * float(std::abs(dy));
    const float apart = std::abs(image_.aov[a].z - image_.aov[b].z);
    return facing * std::exp(-apart / (DEPTH_SLACK * expected + 1e-4F * image_.aov[a].z));
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

  [[nodiscard]] bool is_rim(int x, int y) const {
    bool found = false;
    around(x, y, 1, 1, [&](std::size_t tap, int dx, int dy) {
      found = found || likeness(at(x, y), tap, dx, dy) < RIM_LIKENESS;
    });
    return found;
  }

  /// A pixel of two surfaces has a base colour of both, but its neighbours' light is that of one: the product may be brighter
  /// than both. It is made no brighter than the pixels around that are of one surface, or its own samples.
  [[nodiscard]] Image with_limited_rims(const Image& image, const Image& unfiltered) const {
    Image result = image;
    std::vector<char> rims(image.rgba.size());
    for_rows([&](int y) {
      for (int x = 0; x < width_; ++x) rims[at(x, y)] = is_rim(x, y) ? 1 : 0;
    });
    for_rows([&](int y) {
      for (int x = 0; x < width_; ++x) {
        const std::size_t center = at(x, y);
        if (rims[center] == 0 || !is_surface(center)) continue;
        vec3 most(unfiltered.rgba[center]);
        bool alone = true;  // as all are where points lie loosely
        around(x, y, 2, 1, [&](std::size_t tap, int, int) {
          if (rims[tap] != 0) return;
          alone = false;
          most = glm::max(most, vec3(image.rgba[tap]));
        });
        if (alone) continue;
        result.rgba[center] = vec4(glm::min(vec3(image.rgba[center]), most), image.rgba[center].w);
      }
    });
    return result;
  }

  /// Two halves say little about one pixel's noise; the mean over 7 x 7 of the same surface estimates it.
  [[nodiscard]] Light with_variance(Light light) const {
    light.variance.assign(image_.rgba.size(), 0.0F);
    for_rows([&](int y) {
      for (int x = 0; x < width_; ++x) {
        const std::size_t center = at(x, y);
        if (!is_surface(center)) continue;
        float sum = 0.0F, weights = 0.0F;
        around(x, y, 3, 1, [&](std::size_t tap, int dx, int dy) {
          const float weight = tap == center ? 1.0F : likeness(center, tap, dx, dy);
          const float apart = luminance(light.halves[0][tap]) - luminance(light.halves[1][tap]);
          sum += weight * 0.5F * apart * apart;
          weights += weight;
        });
        light.variance[center] = sum / weights;
      }
    });
    return light;
  }

  [[nodiscard]] Guide guide_of(const Light& light) const {
    const std::size_t pixels = light.variance.size();
    Guide guide{{std::vector<float>(pixels), std::vector<float>(pixels)}, std::vector<float>(pixels)};
    for_rows([&](int y) {
      for (int x = 0; x < width_; ++x) {
        const std::size_t center = at(x, y);
        if (!is_surface(center)) continue;
        vec2 bright(0.0F);
        float variance = 0.0F, weights = 0.0F;
        around(x, y, 1, 1, [&](std::size_t tap, int dx, int dy) {
          const float weight = SMALL_KERNEL[std::abs(dx)] * SMALL_KERNEL[std::abs(dy)] *
                               (tap == center ? 1.0F : likeness(center, tap, dx, dy));
          bright += weight * vec2(luminance(light.halves[0][tap]), luminance(light.halves[1][tap]));
          variance += weight * weight * light.variance[tap];
          weights += weight;
        });
        guide.bright[0][center] = bright.x / weights;
        guide.bright[1][center] = bright.y / weights;
        guide.variance[center] = variance / (weights * weights);
      }
    });
    return guide;
  }

  /// How alike the light of two pixels is in one half, beyond what noise explains (Rousselle et al. 2012, "Adaptive Rendering
  /// with Non-Local Means Filtering", sec. 4).
  static float light_likeness(const Guide& guide, std::size_t half, std::size_t a, std::size_t b,
                              float width) {
    const float apart = guide.bright[half][a] - guide.bright[half][b];
    const float noise = guide.variance[a] + guide.variance[b];
    const float excess = apart * apart - guide.variance[a] - std::min(guide.variance[a], guide.variance[b]);
    return std::exp(-std::max(excess, 0.0F) / (width * width * noise + 1e-12F));
  }

  [[nodiscard]] Light filtered(const Light& light, const Guide& guide, int step) const {
    Light result = light;
    for_rows([&](int y) {
      for (int x = 0; x < width_; ++x) {
        const std::size_t center = at(x, y);
        if (!is_surface(center)) continue;
        vec3 sums[2] = {vec3(0.0F), vec3(0.0F)};
        float variance = 0.0F, weights[2] = {0.0F, 0.0F};
        around(x, y, 2, step, [&](std::size_t tap, int dx, int dy) {
          const float kernel = KERNEL[std::abs(dx)] * KERNEL[std::abs(dy)];
          const float like = tap == center ? 1.0F : likeness(center, tap, dx * step, dy * step);
          if (like < 1e-4F) return;
          // The weights of a half are the other's: they do not favour its own noise.
          for (std::size_t half = 0; half < 2; ++half) {
            const float weight = kernel * like * light_likeness(guide, 1 - half, center, tap, NOISE_WIDTH) *
                                 light_likeness(guide, half, center, tap, OWN_WIDTH);
            sums[half] += weight * light.halves[half][tap];
            weights[half] += weight;
            variance += half == 0 ? weight * weight * light.variance[tap] : 0.0F;
          }
        });
        for (std::size_t half = 0; half < 2; ++half) result.halves[half][center] = sums[half] / weights[half];
        result.variance[center] = variance / (weights[0] * weights[0]);
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
  assert(image.aov.size() == image.rgba.size() && image.part.size() == image.rgba.size() &&
         base.size() == image.rgba.size());
  return Filter(image, base).run();
}

}  // namespace splatray
