#include "engine/image/denoise.h"

#include <array>
#include <cassert>
#include <cmath>
#include <utility>
#include <vector>

#include "engine/base/vector_clones.h"
#include "engine/image/fireflies.h"
#include "engine/image/surface_likeness.h"
#include "shaders/display/denoise_layout.h"

namespace splatray {
namespace {

constexpr float KERNEL[] = {0.375F, 0.25F, 0.0625F};  ///< B3 spline
constexpr float SMALL_KERNEL[] = {0.5F, 0.25F};       ///< of the guide

float luminance(const vec3& color) { return glm::dot(color, vec3(0.2126F, 0.7152F, 0.0722F)); }

using Values = std::vector<float>;  ///< one a pixel

/// One of two pictures of independent samples.
struct Half {
  std::array<Values, 3> rgb;
};

/// Light of each pixel over its base colour, and the variance of one of the halves.
struct Light {
  std::array<Half, 2> halves;
  Values variance;
  /// What single pixels found by rare chance, of all samples: it belongs to the surface around.
  std::array<Values, 3> excess;
};

/// By what pixels are compared: the brightness of both halves, a little smoothed, and its variance.
struct Guide {
  std::array<Values, 2> bright;
  Values variance;
};

float luminance(const Half& half, std::size_t i) {
  return luminance(vec3(half.rgb[0][i], half.rgb[1][i], half.rgb[2][i]));
}

/// A guide from a pixel on.
struct GuideRow {
  const float *bright[2], *variance;

  GuideRow(const Guide& guide, std::size_t pixel)
      : bright{&guide.bright[0][pixel], &guide.bright[1][pixel]}, variance(&guide.variance[pixel]) {}
};

/// Weights of the neighbours' two halves: how alike the surfaces are, and the light beyond what noise explains (Rousselle et al.
/// 2012, "Adaptive Rendering with Non-Local Means Filtering", sec. 4). Those of a half are the other's: they do not favour its
/// own noise.
SPLATRAY_VECTOR_CLONES void find_weights(const GuideRow& here, const GuideRow& there, const float* like,
                                         float kernel, std::size_t count, float* __restrict weight_0,
                                         float* __restrict weight_1) {
  const float *here_0 = here.bright[0], *here_1 = here.bright[1], *here_variance = here.variance;
  const float *there_0 = there.bright[0], *there_1 = there.bright[1], *there_variance = there.variance;
  for (std::size_t k = 0; k < count; ++k) {
    const float own = here_variance[k], other = there_variance[k];
    const float explained = own + (own < other ? own : other), noise = own + other;
    const float apart_0 = here_0[k] - there_0[k], apart_1 = here_1[k] - there_1[k];
    const float beyond_0 = apart_0 * apart_0 - explained, beyond_1 = apart_1 * apart_1 - explained;
    const float excess_0 = beyond_0 > 0.0F ? beyond_0 : 0.0F, excess_1 = beyond_1 > 0.0F ? beyond_1 : 0.0F;
    const float by_other = 1.0F / (DENOISE_NOISE_WIDTH * DENOISE_NOISE_WIDTH * noise + 1e-12F);
    const float by_own = 1.0F / (DENOISE_OWN_WIDTH * DENOISE_OWN_WIDTH * noise + 1e-12F);
    weight_0[k] = kernel * like[k] * decay(-(excess_1 * by_other + excess_0 * by_own));
    weight_1[k] = kernel * like[k] * decay(-(excess_0 * by_other + excess_1 * by_own));
  }
}

SPLATRAY_VECTOR_CLONES void add_weighted(const float* weight, const float* value, std::size_t count,
                                         float* __restrict sum) {
  for (std::size_t k = 0; k < count; ++k) sum[k] += weight[k] * value[k];
}

SPLATRAY_VECTOR_CLONES void add_variance(const float* weight, const float* variance, std::size_t count,
                                         float* __restrict sum) {
  for (std::size_t k = 0; k < count; ++k) sum[k] += weight[k] * weight[k] * variance[k];
}

class Filter {
 public:
  Filter(const Image& image, std::span<const vec4> base)
      : image_(image), base_(base), rows_(image.width, image.height), surfaces_(image, base), rim_(rims()) {}

  /// Image::rgba without noise.
  std::vector<vec4> run() const {
    Light light = taken_apart();
    const std::vector<vec4> unfiltered = joined(light);
    find_variance(light);
    for (int pass = 0; pass < int{DENOISE_PASSES}; ++pass)
      light = filtered(light, guide_of(light), 1 << pass);
    for (Half& half : light.halves)
      for (std::size_t channel = 0; channel < 3; ++channel)
        for (std::size_t i = 0; i < light.variance.size(); ++i)
          half.rgb[channel][i] += light.excess[channel][i];
    return with_limited_rims(joined(light), unfiltered);
  }

 private:
  [[nodiscard]] vec3 base_of(std::size_t i) const {
    return glm::max(vec3(base_[i]), vec3(DENOISE_BASE_LEAST));
  }

  [[nodiscard]] Light taken_apart() const {
    const std::size_t pixels = image_.rgba.size();
    Halves halves = {std::vector<vec3>(pixels), std::vector<vec3>(pixels)};
    const float share = image_.part_share;
    rows_.for_pieces([&](std::size_t first, std::size_t count) {
      for (std::size_t i = first; i < first + count; ++i) {
        const vec3 all = vec3(image_.rgba[i]) / base_of(i), part = vec3(image_.part[i]) / base_of(i);
        halves[0][i] = part;
        halves[1][i] = (all - share * part) / (1.0F - share);
      }
    });
    const Halves found = halves;
    limit_fireflies(halves, image_.width);
    Light light;
    for (int channel = 0; channel < 3; ++channel) {
      const auto c = static_cast<std::size_t>(channel);
      for (Values* values : {&light.halves[0].rgb[c], &light.halves[1].rgb[c], &light.excess[c]})
        values->resize(pixels);
      for (std::size_t i = 0; i < pixels; ++i) {
        for (std::size_t half = 0; half < 2; ++half) light.halves[half].rgb[c][i] = halves[half][i][channel];
        if (rim_[i] != 0) continue;
        light.excess[c][i] = share * (found[0][i][channel] - halves[0][i][channel]) +
                             (1.0F - share) * (found[1][i][channel] - halves[1][i][channel]);
      }
    }
    return light;
  }

  /// The image's pixels with this light.
  [[nodiscard]] std::vector<vec4> joined(const Light& light) const {
    std::vector<vec4> result = image_.rgba;
    rows_.for_pieces([&](std::size_t first, std::size_t count) {
      for (std::size_t i = first; i < first + count; ++i) {
        if (!surfaces_.is_surface(i)) continue;
        vec3 both;
        for (std::size_t channel = 0; channel < 3; ++channel)
          both[static_cast<int>(channel)] =
              glm::mix(light.halves[1].rgb[channel][i], light.halves[0].rgb[channel][i], image_.part_share);
        result[i] = vec4(both * base_of(i), result[i].w);
      }
    });
    return result;
  }

  /// Calls work(first, count) for the pieces that show a surface.
  template <class Work>
  void for_surfaces(const Work& work) const {
    rows_.for_pieces([&](std::size_t first, std::size_t count) {
      if (surfaces_.any_surface(first, count)) work(first, count);
    });
  }

  /// Calls take(taps, likeness) for each place of a square around a piece's pixels.
  template <class Take>
  void around(std::size_t first, std::size_t count, int reach, int step, const Take& take) const {
    Piece like;
    rows_.around(first, count, reach, step, [&](const Taps& taps) {
      surfaces_.find(taps, like);
      take(taps, like.data() + taps.first);
    });
  }

  /// Which pixels have a neighbour of another surface.
  [[nodiscard]] std::vector<char> rims() const {
    std::vector<char> found(image_.rgba.size());
    for_surfaces([&](std::size_t first, std::size_t count) {
      around(first, count, 1, 1, [&](const Taps& taps, const float* like) {
        for (std::size_t k = 0; k < taps.count; ++k)
          found[taps.center + k] |= like[k] < DENOISE_RIM_LIKENESS ? 1 : 0;
      });
    });
    return found;
  }

  /// A pixel of two surfaces has a base colour of both, but its neighbours' light is that of one: the product may be brighter
  /// than both. It is made no brighter than the pixels around that are of one surface, or its own samples.
  [[nodiscard]] std::vector<vec4> with_limited_rims(const std::vector<vec4>& filtered,
                                                    const std::vector<vec4>& unfiltered) const {
    std::vector<vec4> result = filtered;
    for_surfaces([&](std::size_t first, std::size_t count) {
      for (std::size_t i = first; i < first + count; ++i) {
        if (rim_[i] == 0 || !surfaces_.is_surface(i)) continue;
        vec3 most(unfiltered[i]);
        bool alone = true;  // as all are where points lie loosely
        rows_.around(i, 1, 2, 1, [&](const Taps& taps) {
          if (rim_[taps.tap] != 0) return;
          alone = false;
          most = glm::max(most, vec3(filtered[taps.tap]));
        });
        if (!alone) result[i] = vec4(glm::min(vec3(filtered[i]), most), filtered[i].w);
      }
    });
    return result;
  }

  /// Two halves say little about one pixel's noise; the mean over 7 x 7 of the same surface estimates it, and by how it grows with
  /// the light there that of a brighter pixel: what both halves find by chance is rare light, too.
  void find_variance(Light& light) const {
    const std::size_t pixels = image_.rgba.size();
    Values own(pixels), square(pixels);
    rows_.for_pieces([&](std::size_t first, std::size_t count) {
      for (std::size_t i = first; i < first + count; ++i) {
        const float a = luminance(light.halves[0], i), b = luminance(light.halves[1], i);
        own[i] = 0.5F * (a - b) * (a - b);
        square[i] = 0.25F * (a + b) * (a + b);
      }
    });
    light.variance.assign(pixels, 0.0F);
    for_surfaces([&](std::size_t first, std::size_t count) {
      Piece sum{}, squares{}, weights{};
      around(first, count, 3, 1, [&](const Taps& taps, const float* like) {
        add_weighted(like, &own[taps.tap], taps.count, &sum[taps.first]);
        add_weighted(like, &square[taps.tap], taps.count, &squares[taps.first]);
        for (std::size_t k = 0; k < taps.count; ++k) weights[taps.first + k] += like[k];
      });
      for (std::size_t k = 0; k < count; ++k) {
        if (!surfaces_.is_surface(first + k)) continue;
        const float brighter =
            rim_[first + k] == 0 && square[first + k] > 0.0F ? square[first + k] / squares[k] : 0.0F;
        light.variance[first + k] = sum[k] * std::max(1.0F / weights[k], brighter);
        limit_excess(light, first + k, DENOISE_EXCESS_MOST * std::sqrt(squares[k] / weights[k]));
      }
    });
  }

  static void limit_excess(Light& light, std::size_t pixel, float most) {
    std::array<Values, 3>& excess = light.excess;
    const float bright = luminance(vec3(excess[0][pixel], excess[1][pixel], excess[2][pixel]));
    if (bright > most)
      for (Values& channel : excess) channel[pixel] *= most / bright;
  }

  [[nodiscard]] Guide guide_of(const Light& light) const {
    const std::size_t pixels = light.variance.size();
    std::array<Values, 2> bright{Values(pixels), Values(pixels)};
    rows_.for_pieces([&](std::size_t first, std::size_t count) {
      for (std::size_t half = 0; half < 2; ++half)
        for (std::size_t i = first; i < first + count; ++i)
          bright[half][i] = luminance(light.halves[half], i);
    });
    Guide guide{{Values(pixels), Values(pixels)}, Values(pixels)};
    for_surfaces([&](std::size_t first, std::size_t count) {
      Piece sums[2] = {}, variance{}, weights{}, weight;
      around(first, count, 1, 1, [&](const Taps& taps, const float* like) {
        const float kernel = SMALL_KERNEL[std::abs(taps.dx)] * SMALL_KERNEL[std::abs(taps.dy)];
        for (std::size_t k = 0; k < taps.count; ++k) {
          weight[k] = kernel * like[k];
          weights[taps.first + k] += weight[k];
        }
        for (std::size_t half = 0; half < 2; ++half)
          add_weighted(weight.data(), &bright[half][taps.tap], taps.count, &sums[half][taps.first]);
        add_variance(weight.data(), &light.variance[taps.tap], taps.count, &variance[taps.first]);
      });
      for (std::size_t k = 0; k < count; ++k) {
        if (!surfaces_.is_surface(first + k)) continue;
        guide.bright[0][first + k] = sums[0][k] / weights[k];
        guide.bright[1][first + k] = sums[1][k] / weights[k];
        guide.variance[first + k] = variance[k] / (weights[k] * weights[k]);
      }
    });
    return guide;
  }

  [[nodiscard]] Light filtered(const Light& light, const Guide& guide, int step) const {
    Light result = light;
    for_surfaces([&](std::size_t first, std::size_t count) {
      std::array<Piece, 3> sums[2] = {}, excess{};
      Piece variance{}, weights[2] = {}, weight[2], others{}, spread;
      around(first, count, 2, step, [&](const Taps& taps, const float* like) {
        const float kernel = KERNEL[std::abs(taps.dx / step)] * KERNEL[std::abs(taps.dy / step)];
        find_weights({guide, taps.center}, {guide, taps.tap}, like, kernel, taps.count, weight[0].data(),
                     weight[1].data());
        for (std::size_t half = 0; half < 2; ++half) {
          for (std::size_t k = 0; k < taps.count; ++k) weights[half][taps.first + k] += weight[half][k];
          for (std::size_t channel = 0; channel < 3; ++channel)
            add_weighted(weight[half].data(), &light.halves[half].rgb[channel][taps.tap], taps.count,
                         &sums[half][channel][taps.first]);
        }
        add_variance(weight[0].data(), &light.variance[taps.tap], taps.count, &variance[taps.first]);
        if (step == 1 && taps.center == taps.tap) return;  // a pixel alone loses its excess
        for (std::size_t k = 0; k < taps.count; ++k) {
          spread[k] = kernel * like[k];
          others[taps.first + k] += spread[k];
        }
        for (std::size_t channel = 0; channel < 3; ++channel)
          add_weighted(spread.data(), &light.excess[channel][taps.tap], taps.count,
                       &excess[channel][taps.first]);
      });
      for (std::size_t k = 0; k < count; ++k) {
        if (!surfaces_.is_surface(first + k)) continue;
        for (std::size_t channel = 0; channel < 3; ++channel)
          result.excess[channel][first + k] = excess[channel][k] / (others[k] + DENOISE_LEAST_LIKE);
        for (std::size_t half = 0; half < 2; ++half)
          for (std::size_t channel = 0; channel < 3; ++channel)
            result.halves[half].rgb[channel][first + k] = sums[half][channel][k] / weights[half][k];
        result.variance[first + k] = variance[k] / (weights[0][k] * weights[0][k]);
      }
    });
    return result;
  }

  const Image& image_;
  const std::span<const vec4> base_;
  const PixelRows rows_;
  const SurfaceLikeness surfaces_;
  const std::vector<char> rim_;
};

bool is_finite(const vec4& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) && std::isfinite(v.w);
}

void limit(std::span<vec4> pixels, float least, float most) {
  for (vec4& pixel : pixels)
    if (is_finite(pixel)) pixel = vec4(glm::clamp(vec3(pixel), least, most), pixel.w);
}

/// Gives pixels that are not finite the mean of the finite ones around.
void fill_holes(std::span<vec4> pixels, const PixelRows& rows) {
  std::vector<std::pair<std::size_t, vec4>> filled;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    if (is_finite(pixels[i])) continue;
    vec4 sum(0.0F);
    float count = 0.0F;
    rows.around(i, 1, 1, 1, [&](const Taps& taps) {
      if (!is_finite(pixels[taps.tap])) return;
      sum += pixels[taps.tap];
      count += 1.0F;
    });
    filled.emplace_back(i, sum / std::max(count, 1.0F));
  }
  for (const auto& [pixel, value] : filled) pixels[pixel] = value;
}

}  // namespace

void make_finite(Image& image, std::span<vec4> base) {
  const PixelRows rows(image.width, image.height);
  limit(image.rgba, -DENOISE_RADIANCE_MOST, DENOISE_RADIANCE_MOST);
  limit(image.part, -DENOISE_RADIANCE_MOST, DENOISE_RADIANCE_MOST);
  limit(base, 0.0F, 1.0F);
  fill_holes(image.rgba, rows);
  fill_holes(image.part, rows);
  fill_holes(base, rows);
  for (AovPixel& pixel : image.aov) {
    if (pixel.object == NO_OBJECT || is_finite(vec4(pixel.normal, pixel.z))) continue;
    pixel.object = NO_OBJECT;
    pixel.normal = vec3(0.0F);
    pixel.z = INFINITY;
  }
}

Image denoised(Image image, std::vector<vec4> base) {
  assert(image.aov.size() == image.rgba.size() && image.part.size() == image.rgba.size() &&
         base.size() == image.rgba.size());
  make_finite(image, base);
  image.rgba = Filter(image, base).run();
  return image;
}

}  // namespace splatray
