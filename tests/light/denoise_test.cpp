// The filter against noise: nearer to the truth than what it is given, and nothing lost where there is no noise.
#include "engine/image/denoise.h"

#include <gtest/gtest.h>

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
  const Image truth = traced(512, 99), noisy = traced(8, 1);
  const Image clean = denoised(noisy, base());
  RecordProperty("before", std::to_string(error_against(noisy, truth.rgba)));
  RecordProperty("after", std::to_string(error_against(clean, truth.rgba)));
  EXPECT_LT(error_against(clean, truth.rgba), 0.5 * error_against(noisy, truth.rgba));
  EXPECT_NEAR(mean_radiance(clean.rgba), mean_radiance(noisy.rgba), 0.01 * mean_radiance(noisy.rgba));
}

TEST_F(Denoise, LeavesWhatHasNoNoise) {
  Image image = traced(512, 99);
  std::fill(image.error.begin(), image.error.end(), 0.0F);
  const Image clean = denoised(image, base());
  EXPECT_LT(error_against(clean, image.rgba), 1e-3);
}

TEST_F(Denoise, BaseColoursAreThose) {
  const std::vector<vec4> colors = base();
  const vec3 middle(colors[EDGE * EDGE / 2 + EDGE / 2]);
  EXPECT_TRUE(middle.x > 0.19F && middle.x < 0.81F) << middle.x;
  for (const vec4& color : colors) EXPECT_LE(color.x, 1.0F);
}

}  // namespace
}  // namespace splatray::testing
