// What a screen takes of a picture on a device: what the host makes of the same picture, whatever it is, and nothing of another.
#include "app/view/display/screen.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <random>

#include "app/view/display/moving_picture.h"
#include "tests/gpu/shown_tracer.h"
#include "tests/gpu/small_scene.h"

namespace splatray {
namespace {

constexpr std::uint32_t WIDTH = 83, HEIGHT = 61;
constexpr float INF = std::numeric_limits<float>::infinity();

class ScreenTest : public DeviceTest {
 protected:
  /// The bytes of a picture, once the device has made them.
  std::vector<std::uint8_t> bytes(const SharedPicture& picture, std::size_t pixels) {
    screen.wait();
    std::vector<std::uint8_t> read(4 * pixels);
    queue.download(picture->pixels, std::as_writable_bytes(std::span(read)));
    return read;
  }

  CommandQueue queue{device};
  Screen screen{device};
  View view = disc_view(WIDTH, HEIGHT);
};

/// Radiances of all sizes, and what is none.
Image any_image(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> exponent(-20.0F, 12.0F), share(0.0F, 1.0F);
  Image image{WIDTH, HEIGHT, {}, {}};
  for (std::uint32_t i = 0; i < WIDTH * HEIGHT; ++i)
    image.rgba.emplace_back(std::exp2(exponent(random)), std::exp2(exponent(random)),
                            std::exp2(exponent(random)), share(random) < 0.2F ? 0.0F : 1.0F);
  constexpr std::array ODD = {0.0F, -0.0F, -1.0F, -INF, INF, std::numeric_limits<float>::max(), 1e-40F};
  for (std::size_t i = 0; i < ODD.size(); ++i) image.rgba[7 * i][static_cast<int>(i % 3)] = ODD[i];
  image.rgba[1] = vec4(std::nanf(""), 1.0F, 0.5F, 1.0F);
  return image;
}

int most_apart(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b) {
  EXPECT_EQ(a.size(), b.size());
  int most = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    most = std::max(most, std::abs(int{a[i]} - int{b[i]}));
  return most;
}

/// Curves of each channel alone are the host's table, to the byte; those that mix channels are worked out on either.
TEST_F(ScreenTest, ShowsTheHostsBytesInAllTonesAndExposures) {
  const Image image = any_image(1);
  for (const Tone tone : {Tone::soft, Tone::none, Tone::neutral, Tone::agx})
    for (const double ev : {-7.5, 0.0, 3.25}) {
      const auto table = std::make_unique<DisplayTable>(Display(ev, tone));
      const auto shown = bytes(screen.show(image, {*table, view}), image.rgba.size());
      const bool mixes = tone == Tone::neutral || tone == Tone::agx;
      EXPECT_LE(most_apart(shown, table->rgba(image.rgba)), mixes ? 1 : 0)
          << TONE_NAMES[static_cast<std::size_t>(tone)] << " " << ev;
    }
}

/// Base colours at distances with steps between them, and beside nothing.
Image seen_image(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> share(0.0F, 1.0F);
  Image image{WIDTH, HEIGHT, {}, {}};
  for (std::uint32_t y = 0; y < HEIGHT; ++y)
    for (std::uint32_t x = 0; x < WIDTH; ++x) {
      const float distance = (x / 9 % 2 == 0 ? 4.0F : 4.2F) + 0.01F * share(random) + (y > 40 ? 3.0F : 0.0F);
      const bool misses = (x + 2 * y) % 23 == 0;
      image.rgba.emplace_back(share(random), share(random), 0.3F, misses ? 0.0F : distance);
    }
  return image;
}

/// As bright as the picture at rest, after each of two.
TEST_F(ScreenTest, WhatMovesIsShadedAndAsBrightAsAtRest) {
  const auto table = std::make_unique<DisplayTable>(Display(0.5, Tone::soft));
  for (const double ortho : {0.0, 2.0}) {
    view.camera.ortho_height = ortho;
    MovingPicture host;
    screen.forget();
    for (const float bright : {0.0F, 0.09F, 0.4F})
      for (const double strength : {0.0, 1.0}) {
        Image rest = any_image(3);
        for (vec4& pixel : rest.rgba) pixel = vec4(bright, bright, 2.0F * bright, pixel.w);
        if (bright > 0.0F) {
          host.rest(rest, table->rgba(rest.rgba));
          static_cast<void>(screen.show(rest, {*table, view}));
        }
        for (const unsigned seed : {5U, 6U}) {  // the second has the gain of the first
          const Image seen = seen_image(seed);
          const auto expected = host.display(seen, view, strength, *table);
          const auto shown = bytes(screen.show(seen, {*table, view, true, true, strength}), seen.rgba.size());
          EXPECT_LE(most_apart(shown, expected), 1) << bright << " " << strength << " " << seed;
        }
      }
  }
}

/// A picture of more samples than run on the device in one mean.
TEST_F(ScreenTest, ShowsWhatTheTracerGrewAtAnyNumberOfSamples) {
  ShownTracer tracer(device);
  tracer.upload(disc_scene());
  tracer.set_environment({0, 0, {}, vec3(0.4F)});
  Settings settings = plain_settings();
  settings.samples = 150;
  const auto table = std::make_unique<DisplayTable>(Display(0.0, Tone::agx));
  const View small = disc_view(24, 16);
  tracer.begin(small, settings);
  for (int i = 0; tracer.samples() < 150; ++i) {
    tracer.advance(1e-9);  // 8 rows
    const std::uint32_t samples = tracer.samples();
    if (samples == 0 || (i % 13 != 0 && samples != 64 && samples != 128)) continue;
    const auto shown = bytes(screen.show(tracer.grown(), {*table, small}), 24 * 16);
    EXPECT_LE(most_apart(shown, table->rgba(tracer.picture().rgba)), 1) << samples;
  }
}

/// As the tracer marks them.
TEST_F(ScreenTest, KnowsPixelsWhoseLoopsWereCut) {
  const auto table = std::make_unique<DisplayTable>(Display());
  Image image = any_image(1);
  image.rgba[100].w = -1.0F;
  static_cast<void>(screen.show(image, {*table, view}));
  EXPECT_EQ(screen.has_cut_loops(), device.is_cpu());
  static_cast<void>(screen.show(any_image(1), {*table, view}));
  EXPECT_FALSE(screen.has_cut_loops());
}

TEST_F(ScreenTest, APictureThatIsHeldStaysAsItIs) {
  const auto table = std::make_unique<DisplayTable>(Display(0.0, Tone::none));
  std::vector<SharedPicture> held;
  std::vector<std::vector<std::uint8_t>> expected;
  for (unsigned seed = 0; seed < 4; ++seed) {
    const Image image = any_image(seed);
    held.push_back(screen.show(image, {*table, view}));
    expected.push_back(table->rgba(image.rgba));
  }
  for (std::size_t i = 0; i < held.size(); ++i) EXPECT_EQ(bytes(held[i], WIDTH * HEIGHT), expected[i]) << i;
  const VkBuffer freed = held[1]->pixels.get();
  held[1].reset();
  EXPECT_EQ(screen.show(any_image(9), {*table, view})->pixels.get(), freed) << "memory is used again";
}

}  // namespace
}  // namespace splatray
