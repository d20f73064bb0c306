// How fast pictures lose their noise: their samples are low-discrepancy ones (Burley 2020, "Practical Hash-based Owen Scrambling"), of
// which one a pixel is as good as one of independent samples.
#include <gtest/gtest.h>

#include "tests/light/lit.h"

namespace splatray::testing {
namespace {

class Convergence : public Lit {
 protected:
  /// The noise of pictures of this many samples: what those of two seeds differ by.
  double noise(const Camera& camera, Settings settings, std::uint32_t samples) {
    settings.samples = samples;
    Image first = picture(camera, settings, EDGE);
    settings.seed = 2;
    return error_against(first, picture(camera, settings, EDGE).rgba);
  }
  /// The noise of 16 samples, of that of as many independent ones.
  double of_independent(const Camera& camera, const Settings& settings) {
    return noise(camera, settings, 16) / (noise(camera, settings, 1) / 4.0);
  }
  static constexpr std::uint32_t EDGE = 48;
};

TestObject wall(const dvec3& corner, const dvec3& u, const dvec3& v, float albedo) {
  return {rectangle_surface("wall", corner, u, v).make({.count = 1000, .even = true}), grey(albedo)};
}

/// The ball itself is not seen.
TEST_F(Convergence, BallOfLightOverAFloor) {
  show(scene_of({wall({-2.0, 0.0, 2.0}, {4.0, 0.0, 0.0}, {0.0, 0.0, -4.0}, 0.8F)}), constant(0.0F),
       {{LIGHT_POINT, {1.2, 1.0, 0.0}, vec3(1.0F), 0.3}});
  const Camera above{dvec3(0.0, 3.0, 0.0), dvec3(0.0), dvec3(0.0, 0.0, -1.0), 30.0, 0.0};
  Settings settings = lit(1);
  settings.max_bounces = 0;  // with what paths meet it is 0.204
  EXPECT_LE(of_independent(above, settings), 0.2);
}

TEST_F(Convergence, LightThatWallsSendOn) {
  const dvec3 x(2.0, 0.0, 0.0), y(0.0, 2.0, 0.0), z(0.0, 0.0, 2.0);
  const SceneLight lamp{LIGHT_RECTANGLE,  {0.0, 0.99, 0.0}, vec3(10.0F), 0.0,
                        {0.25, 0.0, 0.0}, {0.0, 0.0, 0.25}};
  show(scene_of({wall({-1.0, -1.0, -1.0}, z, x, 0.7F), wall({-1.0, 1.0, -1.0}, x, z, 0.7F),
                 wall({-1.0, -1.0, -1.0}, x, y, 0.7F), wall({-1.0, -1.0, -1.0}, y, z, 0.7F),
                 wall({1.0, -1.0, -1.0}, z, y, 0.7F)}),
       constant(0.0F), {lamp});
  Settings settings = lit(1);
  settings.max_bounces = 4;
  const Camera front{dvec3(0.0, 0.0, 3.6), dvec3(0.0), dvec3(0.0, 1.0, 0.0), 38.0, 0.0};
  EXPECT_LE(of_independent(front, settings), 0.35);
}

}  // namespace
}  // namespace splatray::testing
