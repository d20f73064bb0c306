// Every pixel of pictures of a disc, in sizes that fill no group or tile evenly.
#include <cmath>
#include <limits>

#include "engine/base/error.h"
#include "tests/gpu/shown_tracer.h"
#include "tests/gpu/small_scene.h"

namespace splatray {
namespace {

class PictureTest : public DeviceTest {
 protected:
  void SetUp() override { tracer.upload(disc_scene()); }

  void expect_disc(const View& view, const Settings& settings) {
    const Image image = tracer.render(view, settings);
    ASSERT_EQ(image.rgba.size(), std::size_t{view.width} * view.height);
    std::size_t wrong = 0;
    for (std::uint32_t y = 0; y < view.height; ++y) {
      for (std::uint32_t x = 0; x < view.width; ++x) {
        const Coverage coverage = disc_coverage(view, x, y);
        const float expected = coverage == Coverage::inside ? 1.0F : 0.0F;
        const float found = image.rgba[std::size_t{y} * view.width + x].a;
        if (coverage != Coverage::rim && found != expected) ++wrong;
      }
    }
    EXPECT_EQ(wrong, 0U) << view.width << "x" << view.height << ", order " << settings.order;
  }

  ShownTracer tracer{device};
};

TEST_F(PictureTest, OddSizesAreRightInBothOrders) {
  constexpr std::uint32_t SIZES[][2] = {{1, 1}, {1, 37}, {37, 1}, {7, 9}, {65, 33}, {3000, 2}};
  for (const auto& [width, height] : SIZES) {
    for (const std::uint32_t order : {ORDER_Z, ORDER_LINEAR}) {
      Settings settings = plain_settings();
      settings.order = order;
      expect_disc(disc_view(width, height), settings);
    }
  }
}

TEST_F(PictureTest, TilesMeetWithoutASeam) { expect_disc(disc_view(1501, 1403), plain_settings()); }

TEST_F(PictureTest, WidePictureIsCutIntoColumnsToo) { expect_disc(disc_view(70001, 3), plain_settings()); }

TEST_F(PictureTest, TallPictureStaysWithinTheGroupLimits) {
  Settings settings = plain_settings();
  settings.order = ORDER_LINEAR;
  expect_disc(disc_view(1, 70001), settings);
}

TEST_F(PictureTest, ManySamplesAverageToTheCoveredArea) {
  Settings settings = plain_settings();
  settings.samples = 64;
  const Image image = tracer.render(disc_view(8, 8), settings);
  double covered = 0.0;
  for (const vec4& pixel : image.rgba) covered += pixel.a / static_cast<double>(image.rgba.size());
  const double exact = M_PI * DISC_RADIUS_WORLD * DISC_RADIUS_WORLD / 4.0;
  EXPECT_NEAR(covered, exact, 0.01);
}

TEST_F(PictureTest, GlassThatIsShownAsOpaqueHasTwoSides) {
  Scene scene = disc_scene(2);
  scene.materials[0].flags = MATERIAL_DIELECTRIC;
  tracer.upload(scene);
  View view = disc_view(16, 16);
  const auto object_seen = [&](double side) {
    view.camera.eye.z = side * 3.0;
    Settings settings = plain_settings();
    settings.aov = true;
    settings.look = LOOK_SCAN;
    const Image image = tracer.render(view, settings);
    const std::size_t middle = std::size_t{8} * view.width + 8;
    return image.rgba[middle].a > 0.0F ? static_cast<int>(image.aov[middle].object) : -1;
  };
  EXPECT_EQ(object_seen(1.0), 0) << "the disc in front";
  EXPECT_EQ(object_seen(-1.0), 0) << "through the other, which is opaque and seen from behind";
}

TEST_F(PictureTest, AovsAreTheDiscsDepthNormalAndObject) {
  Settings settings = plain_settings();
  settings.aov = true;
  const View view = disc_view(33, 17);
  const Image image = tracer.render(view, settings);
  ASSERT_EQ(image.aov.size(), image.rgba.size());
  const AovPixel& center = image.aov[17 / 2 * 33 + 33 / 2];
  EXPECT_NEAR(center.z, 3.0F, 1e-5F);
  EXPECT_NEAR(center.normal.z, 1.0F, 1e-6F);
  EXPECT_EQ(center.object, 0U);
  EXPECT_EQ(image.aov[0].object, NO_OBJECT);
  EXPECT_EQ(image.aov[0].z, std::numeric_limits<float>::infinity());
}

TEST_F(PictureTest, CountersCountEachSampleOnceAndNoAov) {
  Settings settings = plain_settings();
  settings.samples = 3;
  settings.aov = true;
  settings.counters = true;
  (void)tracer.render(disc_view(50, 40), settings);
  EXPECT_EQ(tracer.stats().counters[COUNT_PRIMARY], 50U * 40U * 3U);
  EXPECT_GT(tracer.stats().counters[COUNT_HITS], 0U);
  EXPECT_LT(tracer.stats().counters[COUNT_HITS], 50U * 40U * 3U);
  settings.counters = false;
  (void)tracer.render(disc_view(50, 40), settings);
  EXPECT_EQ(tracer.stats().counters[COUNT_PRIMARY], 0U);
}

TEST_F(PictureTest, TimesAreOfTheLastCall) {
  (void)tracer.render(disc_view(400, 300), plain_settings());
  EXPECT_GT(tracer.stats().trace_ms, 0.0);
  EXPECT_GE(tracer.stats().wall_ms, tracer.stats().trace_ms);
}

TEST_F(PictureTest, ProgressRisesToOne) {
  Settings settings = plain_settings();
  settings.samples = 9;
  double last = 0.0;
  const auto rises = [&](double share) {
    EXPECT_GT(share, last);
    last = share;
    return true;
  };
  (void)tracer.render(disc_view(64, 64), settings, rises);
  EXPECT_DOUBLE_EQ(last, 1.0);
}

TEST_F(PictureTest, CancelledPictureThrowsAndTheNextIsWhole) {
  Settings settings = plain_settings();
  settings.samples = 1000;
  int calls = 0;
  const auto stop = [&](double) { return ++calls < 2; };
  try {
    (void)tracer.render(disc_view(64, 64), settings, stop);
    FAIL() << "the picture was not interrupted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::interrupted);
  }
  EXPECT_EQ(calls, 2);
  expect_disc(disc_view(64, 64), plain_settings());
}

TEST_F(PictureTest, SenselessCameraIsRefusedAndTheNextPictureIsWhole) {
  View view = disc_view(8, 8);
  view.camera.target = view.camera.eye;
  EXPECT_THROW((void)tracer.render(view, plain_settings()), Error);
  expect_disc(disc_view(64, 64), plain_settings());
}

}  // namespace
}  // namespace splatray
