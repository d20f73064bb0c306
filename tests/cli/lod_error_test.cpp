/// What a sample of a picture says of the whole one: closed forms, and how often the truth lies where it says.
#include "app/library/picture/lod_error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace splatray {
namespace {

TEST(LodErrorSample, EqualPartsAreExact) {
  const std::vector<LodErrorPart> parts(20, {1.01, 1.0, 3e-4, 3});
  const LodError error = lod_error_of(parts);
  EXPECT_NEAR(error.bias.value, 0.01, 1e-12);
  EXPECT_NEAR(error.bias.high - error.bias.low, 0.0, 1e-12);
  EXPECT_NEAR(error.psnr_db.value, 40.0, 1e-9);
  EXPECT_NEAR(error.psnr_db.low, 40.0, 1e-6);
  EXPECT_EQ(lod_error_text(error), "mean +1.00 % (+1.00 to +1.00), PSNR 40.0 dB (40.0 to 40.0)");
}

TEST(LodErrorSample, NoDifferenceHasNoEnd) {
  const LodError error = lod_error_of(std::vector<LodErrorPart>(20, {1.0, 1.0, 0.0, 3}));
  EXPECT_EQ(error.bias.value, 0.0);
  EXPECT_TRUE(std::isinf(error.psnr_db.low));
  // Noise hides what there is.
  std::vector<LodErrorPart> hidden(20, {1.0, 1.0, -1e-6, 3});
  hidden.front().squares = 1e-6;
  EXPECT_TRUE(std::isinf(lod_error_of(hidden).psnr_db.value));
}

/// A picture of 640x480 whose error differs from place to place, in patches as trees are; 100 samples by the windows of 100 seeds.
TEST(LodErrorSample, TheTruthLiesInMostIntervals) {
  constexpr std::uint32_t WIDTH = 640, HEIGHT = 480;
  const auto patch = [](std::uint32_t x, std::uint32_t y) {
    return std::max(
        0.0, std::sin(0.021 * x + 1.0) * std::cos(0.034 * y) + 0.3 * std::sin(0.13 * x) * std::sin(0.11 * y));
  };
  const auto part_of = [&](const PixelWindow& window) {
    LodErrorPart part;
    for (std::uint32_t y = window.y; y < window.y + window.height; ++y)
      for (std::uint32_t x = window.x; x < window.x + window.width; ++x) {
        const double full = 0.3 + 0.2 * std::sin(0.01 * x), error = 0.05 * patch(x, y) - 0.003;
        part.radiance += 3.0 * (full + error);
        part.radiance_of_all += 3.0 * full;
        part.squares += 3.0 * error * error;
        part.values += 3;
      }
    return part;
  };
  const LodErrorPart whole = part_of({0, 0, WIDTH, HEIGHT});
  const double bias = whole.radiance / whole.radiance_of_all - 1.0;
  const double psnr_db = -10.0 * std::log10(whole.squares / static_cast<double>(whole.values));
  int bias_in = 0, psnr_in = 0, wrong_in = 0;
  for (std::uint32_t seed = 1; seed <= 100; ++seed) {
    std::vector<LodErrorPart> parts;
    for (const PixelWindow& window : lod_error_windows({0, 0, WIDTH, HEIGHT}, seed))
      parts.push_back(part_of(window));
    const LodError error = lod_error_of(parts);
    bias_in += error.bias.low <= bias && bias <= error.bias.high ? 1 : 0;
    psnr_in += error.psnr_db.low <= psnr_db && psnr_db <= error.psnr_db.high ? 1 : 0;
    for (const double wrong : {-bias, 3.0 * bias})
      wrong_in += error.bias.low <= wrong && wrong <= error.bias.high ? 1 : 0;
  }
  EXPECT_GE(bias_in, 90);
  EXPECT_GE(psnr_in, 90);
  EXPECT_LE(wrong_in, 5) << "intervals that hold all say nothing";
}

TEST(LodErrorSample, WindowsLieInTheirFields) {
  for (const PixelWindow made :
       {PixelWindow{0, 0, 1920, 1080}, PixelWindow{7, 9, 50, 33}, PixelWindow{3, 0, 2, 3}}) {
    const std::vector<PixelWindow> windows = lod_error_windows(made, 5);
    EXPECT_EQ(windows.size(), std::min(5U, made.width) * std::min(4U, made.height));
    for (std::size_t i = 0; i < windows.size(); ++i) {
      const PixelWindow& one = windows[i];
      EXPECT_GE(one.x, made.x);
      EXPECT_GE(one.y, made.y);
      EXPECT_LE(one.x + one.width, made.x + made.width);
      EXPECT_LE(one.y + one.height, made.y + made.height);
      EXPECT_TRUE(one.width > 0 && one.width <= 32 && one.height > 0 && one.height <= 32);
      for (std::size_t j = 0; j < i; ++j)
        EXPECT_TRUE(windows[j].x + windows[j].width <= one.x || one.x + one.width <= windows[j].x ||
                    windows[j].y + windows[j].height <= one.y || one.y + one.height <= windows[j].y);
    }
  }
}

}  // namespace
}  // namespace splatray
