#include "app/view/model/false_color.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "app/library/palette.h"

namespace splatray {
namespace {

using Rgb = std::array<int, 3>;

AovPixel hit(float z = 1.0F, std::uint32_t object = 0, std::uint32_t splat = 1) {
  AovPixel pixel{};
  pixel.normal = vec3(0.0F, 0.0F, 1.0F);
  pixel.z = z;
  pixel.object = object;
  pixel.splat = splat;
  return pixel;
}

AovPixel miss() {
  AovPixel pixel{};
  pixel.z = std::numeric_limits<float>::infinity();
  pixel.object = NO_OBJECT;
  return pixel;
}

std::vector<Rgb> colors(const std::vector<AovPixel>& pixels, ViewMode mode) {
  const std::vector<std::uint8_t> rgba = false_color(pixels, mode, color_range(pixels, mode));
  EXPECT_EQ(rgba.size(), 4 * pixels.size());
  std::vector<Rgb> rgb;
  for (std::size_t i = 0; i < rgba.size(); i += 4) {
    EXPECT_EQ(rgba[i + 3], 255);
    rgb.push_back({rgba[i], rgba[i + 1], rgba[i + 2]});
  }
  return rgb;
}

/// CIE L* of a display-encoded colour: how bright it looks, 0..100.
double looked_lightness(const glm::vec3& color) {
  const auto linear = [](double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); };
  const double y = 0.2126 * linear(color.r) + 0.7152 * linear(color.g) + 0.0722 * linear(color.b);
  return y > 0.008856 ? 116.0 * std::cbrt(y) - 16.0 : 903.3 * y;
}

TEST(FalseColorTest, HeatGrowsBrighterInEvenSteps) {
  constexpr int STEPS = 16;
  const double step = (looked_lightness(heat_color(1.0F)) - looked_lightness(heat_color(0.0F))) / STEPS;
  EXPECT_GT(step, 3.0);
  for (int i = 0; i < STEPS; ++i) {
    const double low = looked_lightness(heat_color(static_cast<float>(i) / STEPS));
    const double high = looked_lightness(heat_color(static_cast<float>(i + 1) / STEPS));
    EXPECT_NEAR(high - low, step, 0.35 * step) << i;
  }
  EXPECT_EQ(heat_color(-3.0F), heat_color(0.0F));
  EXPECT_EQ(heat_color(7.0F), heat_color(1.0F));
  EXPECT_EQ(heat_color(std::numeric_limits<float>::quiet_NaN()), heat_color(0.0F));
}

TEST(FalseColorTest, NormalsAreAxesAsColours) {
  AovPixel pixel = hit();
  pixel.normal = vec3(1.0F, -1.0F, 0.0F);
  EXPECT_EQ(colors({pixel}, ViewMode::normal)[0], (Rgb{255, 0, 128}));
}

TEST(FalseColorTest, DepthSpansTheHitsAlone) {
  const std::vector<AovPixel> pixels = {hit(2.0F), miss(), hit(5.0F), hit(3.5F)};
  const ColorRange range = color_range(pixels, ViewMode::depth);
  EXPECT_EQ(range.low, 2.0);
  EXPECT_EQ(range.high, 5.0);
  const auto shown = colors(pixels, ViewMode::depth);
  EXPECT_EQ(std::set<Rgb>(shown.begin(), shown.end()).size(), 4U);
  EXPECT_EQ(shown[1][0], shown[1][2]);  // grey
}

TEST(FalseColorTest, CountsSpanAllPixelsButFewOutliers) {
  std::vector<AovPixel> pixels(1000, miss());  // misses cost too
  for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i].steps = static_cast<std::uint32_t>(i % 100);
  pixels[0].steps = 1000000;
  const ColorRange range = color_range(pixels, ViewMode::steps);
  EXPECT_EQ(range.low, 0.0);
  EXPECT_EQ(range.high, 99.0);
  const auto shown = colors(pixels, ViewMode::steps);
  EXPECT_EQ(shown[0], shown[99]);
  EXPECT_NE(shown[1], shown[99]);
}

TEST(FalseColorTest, RangesOfNothingAndOfOneValueCanBeShown) {
  for (const ViewMode mode : {ViewMode::depth, ViewMode::tests, ViewMode::steps, ViewMode::normal})
    for (const std::vector<AovPixel>& pixels :
         {std::vector<AovPixel>{}, {miss()}, {hit(3.0F), hit(3.0F)}, {hit(1e30F)}}) {
      const ColorRange range = color_range(pixels, mode);
      EXPECT_GT(range.high, range.low);
      (void)colors(pixels, mode);
    }
}

TEST(FalseColorTest, NeighbouringObjectsDiffer) {
  std::vector<AovPixel> pixels;
  for (std::uint32_t object = 0; object < 300; ++object) pixels.push_back(hit(1.0F, object));
  const auto shown = colors(pixels, ViewMode::object);
  for (std::size_t i = 1; i < shown.size(); ++i) {
    int apart = 0;
    for (std::size_t c = 0; c < 3; ++c) apart += std::abs(shown[i][c] - shown[i - 1][c]);
    EXPECT_GT(apart, 60) << i;
  }
}

TEST(FalseColorTest, SplatColoursDoNotDependOnTheFace) {
  const auto shown =
      colors({hit(1.0F, 0, 0xABCD0000), hit(1.0F, 0, 0xABCD0001), hit(1.0F, 0, 0x1234567)}, ViewMode::splat);
  EXPECT_EQ(shown[0], shown[1]);
  EXPECT_NE(shown[0], shown[2]);
}

TEST(FalseColorTest, BackFacesAreRedAndFrontFacesGrey) {
  const auto shown = colors({hit(1.0F, 0, 1), hit(1.0F, 0, 0)}, ViewMode::facing);
  EXPECT_EQ(shown[0][0], shown[0][1]);
  EXPECT_EQ(shown[0][1], shown[0][2]);
  EXPECT_GT(shown[1][0], 3 * shown[1][1]);
}

TEST(FalseColorTest, EveryModeHasANameAndALegend) {
  std::set<std::string> names;
  for (int i = 0; i < VIEW_MODE_COUNT; ++i) {
    const auto mode = static_cast<ViewMode>(i);
    names.insert(view_mode_name(mode));
    EXPECT_EQ(std::string(view_mode_legend(mode)).empty(), mode == ViewMode::shaded);
  }
  for (const ViewMode mode : {ViewMode::depth, ViewMode::tests, ViewMode::steps})
    EXPECT_TRUE(has_scale(mode));
  for (const ViewMode mode : {ViewMode::normal, ViewMode::object, ViewMode::facing})
    EXPECT_FALSE(has_scale(mode));
  EXPECT_EQ(names.size(), static_cast<std::size_t>(VIEW_MODE_COUNT));
  EXPECT_EQ(std::string(view_mode_name(ViewMode::steps)), "steps");
}

}  // namespace
}  // namespace splatray
