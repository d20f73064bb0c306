// The filter against noise: nearer to the truth than what it is given, and nothing lost where there is no noise.
#include "engine/image/denoise.h"

#include <gtest/gtest.h>

#include <random>

#include "engine/base/error.h"
#include "tests/all_tests.h"
#include "tests/light/lit.h"

namespace splatray::testing {
namespace {

constexpr std::uint32_t EDGE = 64;

/// A ball on a plane, both in stripes, under the studio's lamps.
class Denoise : public Plane {
 protected:
  Denoise() {
    TestObject stripes = floor();
    append(stripes.points, ball_at({0.0, 0.4, 0.0}, 0.4, 4000));
    for (const dvec3& position : stripes.points.position)
      stripes.points.color.push_back(std::sin(20.0 * position.x) > 0.0 ? vec3(0.8F) : vec3(0.2F));
    show(scene_of({stripes}), studio_environment(), {});
    settings_ = lit(8);
    settings_.max_bounces = 2;
    settings_.aov = settings_.estimate_error = true;
  }

  Image traced(std::uint32_t samples, std::uint32_t seed) {
    settings_.samples = samples;
    settings_.seed = seed;
    return picture(camera_, settings_, EDGE);
  }
  std::vector<vec4> base() {
    Settings plain = settings_;
    plain.look = LOOK_BASE;
    plain.samples = 16;
    plain.aov = plain.estimate_error = false;
    return picture(camera_, plain, EDGE).rgba;
  }
  const Camera camera_{dvec3(1.0, 2.0, 2.5), dvec3(0.0, 0.3, 0.0), dvec3(0.0, 1.0, 0.0), 40.0, 0.0};
  Settings settings_;
};

TEST_F(Denoise, IsNearerToTheTruth) {
  SPLATRAY_NIGHTLY();
  const Image truth = traced(512, 99), noisy = traced(8, 1);
  const Image clean = denoised(noisy, base());
  RecordProperty("before", std::to_string(error_against(noisy, truth.rgba)));
  RecordProperty("after", std::to_string(error_against(clean, truth.rgba)));
  EXPECT_LT(error_against(clean, truth.rgba), 0.5 * error_against(noisy, truth.rgba));
  EXPECT_NEAR(mean_radiance(clean.rgba), mean_radiance(noisy.rgba), 0.01 * mean_radiance(noisy.rgba));
}

TEST_F(Denoise, LeavesWhatHasNoNoise) {
  SPLATRAY_NIGHTLY();
  Image image = traced(512, 99);
  image.part = image.rgba;
  const Image clean = denoised(image, base());
  EXPECT_LT(error_against(clean, image.rgba), 1e-3);
}

/// Blocks of samples, joined on the host, and a number that is no multiple of one.
TEST_F(Denoise, BaseColoursComeWithThePicture) {
  settings_.samples = 70;
  const Image alone = picture(camera_, settings_, EDGE);
  Settings plain = settings_;
  plain.look = LOOK_BASE;
  plain.aov = plain.estimate_error = false;
  const Image base = picture(camera_, plain, EDGE);
  settings_.albedo = true;
  const Image both = picture(camera_, settings_, EDGE);
  EXPECT_EQ(both.rgba, alone.rgba);
  EXPECT_EQ(both.part, alone.part);
  std::size_t met = 0, apart = 0;
  for (std::size_t i = 0; i < base.rgba.size(); ++i) {
    if (base.rgba[i].w == 0.0F) continue;
    ++met;
    apart += glm::all(glm::lessThan(glm::abs(both.albedo[i] - base.rgba[i]), vec4(1e-6F))) ? 0 : 1;
  }
  EXPECT_GT(met, EDGE * EDGE / 2);
  EXPECT_EQ(apart, 0U);
  settings_.look = LOOK_PAPER;
  EXPECT_THROW(static_cast<void>(picture(camera_, settings_, EDGE)), Error);
}

/// A grey wall with noise of a standard error of a tenth, and two bright pixels.
struct Wall {
  Image image{EDGE, EDGE, {}, {}};
  std::vector<vec4> base = std::vector<vec4>(EDGE * EDGE, vec4(1.0F));
  static constexpr std::size_t LAMP = 20 * EDGE + 20, SPARK = 40 * EDGE + 40;

  Wall() {
    std::mt19937 random(3);
    std::normal_distribution<float> noise(0.0F, 0.14F);
    AovPixel pixel{};
    pixel.normal = vec3(0.0F, 0.0F, 1.0F);
    pixel.z = 1.0F;
    image.aov.assign(EDGE * EDGE, pixel);
    for (std::size_t i = 0; i < EDGE * EDGE; ++i) {
      const float half = 0.5F + noise(random), other = 0.5F + noise(random);
      image.part.emplace_back(vec4(vec3(half), 1.0F));
      image.rgba.emplace_back(vec4(vec3(0.5F * (half + other)), 1.0F));
    }
    image.part[LAMP] = image.rgba[LAMP] = vec4(50.0F);
    image.part[SPARK] = vec4(100.0F);
    image.rgba[SPARK] = vec4(50.0F);
  }
};

TEST(DenoiseWall, WhatOneHalfAloneFindsBrightIsNoBlotch) {
  const Wall wall;
  const Image clean = denoised(wall.image, wall.base);
  float most = 0.0F, deviation = 0.0F;
  for (std::size_t i = 30 * EDGE; i < EDGE * EDGE; ++i) {
    most = std::max(most, std::abs(clean.rgba[i].x - 0.5F));
    deviation += (clean.rgba[i].x - 0.5F) * (clean.rgba[i].x - 0.5F);
  }
  EXPECT_LT(most, 0.15F);
  EXPECT_LT(std::sqrt(deviation / (34.0F * EDGE)), 0.02F);
}

TEST(DenoiseWall, WhatBothHalvesFindBrightStays) {
  const Wall wall;
  EXPECT_NEAR(denoised(wall.image, wall.base).rgba[Wall::LAMP].x, 50.0F, 1.0F);
}

/// A wall of base 0.2 in light of 0.5, before it one of base 0.9 in light of 0.05, whose edge covers half of the pixels of a column.
/// These have more noise than the lights differ.
TEST(DenoiseWall, APixelOfTwoSurfacesIsNotBrighterThanBoth) {
  constexpr std::size_t SEAM = EDGE / 2;
  Wall wall;
  std::mt19937 random(5);
  std::normal_distribution<float> noise(0.0F, 0.05F);
  for (std::size_t i = 0; i < EDGE * EDGE; ++i) {
    const std::size_t x = i % EDGE;
    const float covered = x < SEAM ? 0.0F : (x == SEAM ? 0.5F : 1.0F);
    wall.base[i] = vec4(vec3(glm::mix(0.2F, 0.9F, covered)), 1.0F);
    wall.image.aov[i].object = x > SEAM ? 1 : 0;
    const float radiance = glm::mix(0.1F, 0.045F, covered);
    const float half = radiance + noise(random), other = radiance + noise(random);
    wall.image.part[i] = vec4(vec3(half), 1.0F);
    wall.image.rgba[i] = vec4(vec3(0.5F * (half + other)), 1.0F);
  }
  const Image clean = denoised(wall.image, wall.base);
  float mean = 0.0F;
  for (std::size_t y = 0; y < EDGE; ++y) mean += clean.rgba[y * EDGE + SEAM].x / float(EDGE);
  EXPECT_LT(mean, 0.115F);  // 0.1 and what is left of noise; light times base would be up to 0.275
  EXPECT_GT(mean, 0.045F);
}

TEST_F(Denoise, BaseColoursAreThose) {
  const std::vector<vec4> colors = base();
  const vec3 middle(colors[EDGE * EDGE / 2 + EDGE / 2]);
  EXPECT_TRUE(middle.x > 0.19F && middle.x < 0.81F) << middle.x;
  for (const vec4& color : colors) EXPECT_LE(color.x, 1.0F);
}

}  // namespace
}  // namespace splatray::testing
