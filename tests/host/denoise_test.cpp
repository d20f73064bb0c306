// The filter against noise of pictures with pixels that are poisoned: all that comes out is finite and between what went in.
#include "engine/image/denoise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

namespace splatray {
namespace {

constexpr std::uint32_t WIDTH = 70, HEIGHT = 50;
constexpr float NOT_A_NUMBER = std::numeric_limits<float>::quiet_NaN();

/// A picture of one surface, of which random pixels are missed or covered in part.
struct Picture {
  Image image{WIDTH, HEIGHT, {}, {}};
  std::vector<vec4> base;
  std::mt19937 random;

  explicit Picture(unsigned seed) : random(seed) {
    for (std::uint32_t i = 0; i < WIDTH * HEIGHT; ++i) {
      const float coverage = std::min(below(1.5F), 1.0F);
      AovPixel pixel{};
      pixel.normal = vec3(0.0F, 0.0F, 1.0F);
      pixel.z = 1.0F + below(1e-4F);
      if (below(1.0F) < 0.1F) pixel.object = NO_OBJECT;
      image.aov.push_back(pixel);
      const float half = coverage * (0.4F + below(0.2F)), other = coverage * (0.4F + below(0.2F));
      image.part.emplace_back(vec3(half), coverage);
      image.rgba.emplace_back(vec3(0.5F * (half + other)), coverage);
      base.emplace_back(vec3(coverage), coverage);
    }
  }
  float below(float most) { return std::uniform_real_distribution<float>(0.0F, most)(random); }
  std::size_t any_pixel() { return random() % (WIDTH * HEIGHT); }
  float poison() {
    constexpr float POISONS[] = {INFINITY, -INFINITY, NOT_A_NUMBER, 0.0F,  -0.0F,
                                 3e38F,    -3e38F,    1e20F,        1e-40F};
    return POISONS[random() % std::size(POISONS)];
  }
};

void expect_finite(const Image& image, const std::string& what) {
  std::size_t bad = 0;
  for (const vec4& pixel : image.rgba)
    for (int channel = 0; channel < 4; ++channel) bad += std::isfinite(pixel[channel]) ? 0 : 1;
  EXPECT_EQ(bad, 0U) << what;
}

TEST(DenoisePoison, EveryInputMayHoldAnything) {
  const std::vector<std::pair<const char*, std::function<void(Picture&, std::size_t)>>> ways = {
      {"colour", [](Picture& p, std::size_t i) { p.image.rgba[i][int(p.random() % 3)] = p.poison(); }},
      {"coverage", [](Picture& p, std::size_t i) { p.image.rgba[i].w = p.poison(); }},
      {"half", [](Picture& p, std::size_t i) { p.image.part[i][int(p.random() % 4)] = p.poison(); }},
      {"base", [](Picture& p, std::size_t i) { p.base[i][int(p.random() % 4)] = p.poison(); }},
      {"normal", [](Picture& p, std::size_t i) { p.image.aov[i].normal[int(p.random() % 3)] = p.poison(); }},
      {"depth", [](Picture& p, std::size_t i) { p.image.aov[i].z = p.poison(); }},
      {"no variance", [](Picture& p, std::size_t i) { p.image.part[i] = p.image.rgba[i]; }}};
  for (unsigned seed = 1; seed <= 4; ++seed) {
    Picture all(seed);
    for (const auto& [name, poison] : ways) {
      Picture one(seed);
      for (int times = 0; times < 40; ++times) {
        poison(one, one.any_pixel());
        poison(all, all.any_pixel());
      }
      expect_finite(denoised(one.image, one.base), name + (", seed " + std::to_string(seed)));
    }
    expect_finite(denoised(all.image, all.base), "all, seed " + std::to_string(seed));
  }
}

/// Filters average: light over base colour lies between the least and the most of what is around.
TEST(DenoisePoison, WhatComesOutLiesBetweenWhatWentIn) {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    Picture picture(seed);
    for (vec4& base : picture.base) base = vec4(1.0F);
    for (int times = 0; times < 60; ++times) {
      picture.image.aov[picture.any_pixel()].z = picture.poison();
      picture.image.aov[picture.any_pixel()].normal = vec3(picture.poison());
      picture.image.rgba[picture.any_pixel()].x = NOT_A_NUMBER;
    }
    const Image clean = denoised(picture.image, picture.base);
    for (const vec4& pixel : clean.rgba) {
      ASSERT_GE(pixel.x, -1e-5F) << seed;
      ASSERT_LE(pixel.x, 0.6F + 1e-5F) << seed;
    }
  }
}

/// Drawings have parallel rays, whose hits may lie on both sides of the plane that depths are measured from.
TEST(DenoisePoison, DepthsOnBothSidesOfZeroAreDepths) {
  Picture picture(7);
  for (AovPixel& pixel : picture.image.aov)
    pixel.z = picture.below(1.0F) < 0.5F ? 0.0F : picture.below(0.02F) - 0.01F;
  expect_finite(denoised(picture.image, picture.base), "depths around 0");
}

/// Depth makes no difference where it is shifted: a flat wall at 0 is filtered as one at 1 is.
TEST(DenoisePoison, AWallAtDepthZeroIsFiltered) {
  Picture picture(9);
  const auto deviation_at = [&](float depth) {
    for (AovPixel& pixel : picture.image.aov)
      if (pixel.object != NO_OBJECT) pixel.z = depth;
    const Image clean = denoised(picture.image, picture.base);
    double squares = 0.0;
    for (std::size_t i = 0; i < clean.rgba.size(); ++i)
      if (clean.aov[i].object != NO_OBJECT)
        squares += std::pow(clean.rgba[i].x - 0.5 * picture.base[i].x, 2.0);
    return std::sqrt(squares / double(clean.rgba.size()));
  };
  EXPECT_NEAR(deviation_at(0.0F), deviation_at(1.0F), 1e-6);
}

/// A wall in a light that few samples find: one of eight of the halves has light, eight times the mean on the mean.
struct RareLight {
  static constexpr float MEAN = 0.5F;
  Picture picture{11};
  Image clean;

  RareLight() {
    for (std::size_t i = 0; i < picture.base.size(); ++i) {
      const auto found = [&] {
        return picture.random() % 8 == 0
                   ? 8.0F * MEAN * std::exponential_distribution<float>()(picture.random)
                   : 0.0F;
      };
      const float half = found(), other = found();
      picture.base[i] = vec4(1.0F);
      picture.image.aov[i].object = 0;
      picture.image.aov[i].z = 1.0F;
      picture.image.part[i] = vec4(vec3(half), 1.0F);
      picture.image.rgba[i] = vec4(vec3(0.5F * (half + other)), 1.0F);
    }
    clean = denoised(picture.image, picture.base);
  }
};

TEST(DenoiseRareLight, KeepsItsEnergy) {
  const RareLight wall;
  double before = 0.0, after = 0.0;
  for (std::size_t i = 0; i < wall.clean.rgba.size(); ++i) {
    before += double{wall.picture.image.rgba[i].x};
    after += double{wall.clean.rgba[i].x};
  }
  EXPECT_NEAR(after / before, 1.0, 0.05);  // 0.40 without what is taken from bright pixels
}

TEST(DenoiseRareLight, LeavesNoDots) {
  const RareLight wall;
  double squares = 0.0;
  float most = 0.0F;
  for (const vec4& pixel : wall.clean.rgba) {
    squares += std::pow(double{pixel.x - RareLight::MEAN}, 2.0);
    most = std::max(most, pixel.x);
  }
  EXPECT_LT(most, 6.0F * RareLight::MEAN);
  EXPECT_LT(std::sqrt(squares / double(wall.clean.rgba.size())), 0.4 * double{RareLight::MEAN});
}

/// Stripes of two base colours, 3 pixels wide, under a highlight that is the same on both: what light over base colour is of one stripe is
/// not what it is of the other, and both keep theirs.
TEST(DenoisePaint, StripesUnderAHighlightStaySharp) {
  constexpr float HIGHLIGHT = 0.1F, LIGHT = 0.5F;
  Picture picture(12);
  std::normal_distribution<float> noise(0.0F, 0.05F);
  std::vector<float> truth;
  for (std::size_t i = 0; i < picture.base.size(); ++i) {
    const float base = i % WIDTH / 3 % 2 == 0 ? 0.8F : 0.1F;
    truth.push_back(base * LIGHT + HIGHLIGHT);
    const float half = truth[i] + noise(picture.random), other = truth[i] + noise(picture.random);
    picture.base[i] = vec4(vec3(base), 1.0F);
    picture.image.aov[i].object = 0;
    picture.image.aov[i].z = 1.0F;
    picture.image.part[i] = vec4(vec3(half), 1.0F);
    picture.image.rgba[i] = vec4(vec3(0.5F * (half + other)), 1.0F);
  }
  const Image clean = denoised(picture.image, picture.base);
  double squares = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i) squares += std::pow(double{clean.rgba[i].x - truth[i]}, 2.0);
  EXPECT_LT(std::sqrt(squares / double(truth.size())), 0.01);
}

}  // namespace
}  // namespace splatray
