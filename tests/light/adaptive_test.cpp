// Pictures that end when they are good enough, and the errors they tell.
#include <gtest/gtest.h>

#include <cmath>

#include "data/shapes.h"
#include "engine/gpu/tracer.h"
#include "engine/image/picture_error.h"
#include "engine/scene/environment.h"
#include "tests/trace/scenes.h"

namespace splatray::testing {
namespace {

class Adaptive : public ::testing::Test {
 protected:
  Adaptive() : camera_(default_camera(scene_, 1.0)) {
    tracer_.upload(scene_);
    tracer_.set_environment(studio_environment());
    settings_.look = LOOK_LIT;
    settings_.max_bounces = 2;
  }
  void TearDown() override { EXPECT_EQ(context_.validation_messages(), 0U); }

  [[nodiscard]] View view() const { return {camera_, 72, 56}; }

  /// The relative error of a picture against one of many samples.
  double error_of(const Image& image) {
    if (truth_.empty()) {
      Settings many = settings_;
      many.samples = 1024;
      many.seed = 77;
      truth_ = tracer_.render(view(), many).rgba;
    }
    Image apart = image;
    apart.error = pixel_errors(image.rgba, truth_);
    return relative_error(apart);
  }

  const Scene scene_ =
      scene_of({{sphere({.count = 2000, .even = true, .seed = 3}, 1.0), test_material(MATERIAL_TWO_SIDED)}});
  const Camera camera_;
  Context context_;
  Tracer tracer_{context_};
  Settings settings_;
  std::vector<vec4> truth_;
};

TEST_F(Adaptive, ReachesTheErrorAskedFor) {
  settings_.samples = 65536;
  const Image coarse = tracer_.render_until(view(), settings_, {.error = 0.1});
  const double coarse_samples = tracer_.stats().samples;
  const Image fine = tracer_.render_until(view(), settings_, {.error = 0.03});
  EXPECT_LT(error_of(fine), 0.03);
  EXPECT_LT(error_of(coarse), 0.1);
  EXPECT_LT(error_of(fine), error_of(coarse));
  EXPECT_GT(tracer_.stats().samples, 1.5 * coarse_samples);
  EXPECT_NEAR(tracer_.stats().error, error_of(fine), 0.6 * error_of(fine));
  ASSERT_EQ(fine.error.size(), fine.rgba.size());
}

TEST_F(Adaptive, FewerSamplesWhereThereIsLittleToSee) {
  settings_.samples = 65536;
  (void)tracer_.render_until(view(), settings_, {.error = 0.03});
  const double adaptive = tracer_.stats().samples;
  // As many samples everywhere as the worst region took would be more.
  EXPECT_LT(adaptive, 1024.0);
  EXPECT_GT(adaptive, 8.0);
}

TEST_F(Adaptive, EndsInTime) {
  settings_.samples = 65536;
  const Image image = tracer_.render_until(view(), settings_, {.seconds = 0.5});
  EXPECT_LT(tracer_.stats().wall_ms, 5000.0);
  EXPECT_GT(tracer_.stats().samples, 8.0);
  EXPECT_LT(error_of(image), 0.2);
}

TEST_F(Adaptive, IsUnbiased) {
  settings_.samples = 65536;
  double sum = 0.0, squares = 0.0;
  constexpr std::uint32_t PICTURES = 24;
  const double truth =
      (static_cast<void>(error_of(Image{72, 56, std::vector<vec4>(72 * 56), {}})), mean_radiance(truth_));
  for (std::uint32_t seed = 1; seed <= PICTURES; ++seed) {
    settings_.seed = seed;
    const double mean =
        mean_radiance(tracer_.render_until(view(), settings_, {.error = 0.3}).rgba) / truth - 1.0;
    sum += mean;
    squares += mean * mean;
  }
  const double mean = sum / PICTURES, error = std::sqrt((squares / PICTURES - mean * mean) / (PICTURES - 1));
  EXPECT_NEAR(mean, 0.0, 4.0 * error + 1e-4);
  EXPECT_LT(error, 0.01);
}

TEST_F(Adaptive, FixedSamplesTellTheirError) {
  settings_.samples = 32;
  settings_.estimate_error = true;
  const Image image = tracer_.render(view(), settings_);
  EXPECT_GT(tracer_.stats().error, 0.5 * error_of(image));
  EXPECT_LT(tracer_.stats().error, 4.0 * error_of(image));
  settings_.estimate_error = false;
  EXPECT_EQ(tracer_.render(view(), settings_).rgba, image.rgba);
}

TEST_F(Adaptive, SameBytesStagedOrNotCulledOrNot) {
  settings_.samples = 4;
  const Image image = tracer_.render(view(), settings_);
  Settings other = settings_;
  other.stages = false;
  EXPECT_EQ(tracer_.render(view(), other).rgba, image.rgba);
  other = settings_;
  other.cull = false;
  EXPECT_EQ(tracer_.render(view(), other).rgba, image.rgba);
}

}  // namespace
}  // namespace splatray::testing
