// The filter against noise on a device: what the host's gives, whatever its inputs hold.
#include "engine/device/vulkan/device_filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "engine/image/denoise.h"
#include "tests/gpu/small_scene.h"

namespace splatray {
namespace {

constexpr std::uint32_t WIDTH = 300, HEIGHT = 40;  ///< more than a piece of a row
/// What the order of sums and the devices' functions may leave, of a channel or, where that is darker, of DARK.
constexpr double BOUND = 1e-4, DARK = 1e-2;

/// Two tilted planes with paint, one before the other, and misses around and among them; noise that grows with the light.
struct NoisyImage {
  Image image{WIDTH, HEIGHT, {}, {}};
  std::vector<vec4> base;
  std::mt19937 random;

  explicit NoisyImage(unsigned seed) : random(seed) {
    image.part_share = 0.375F;
    for (std::uint32_t y = 0; y < HEIGHT; ++y)
      for (std::uint32_t x = 0; x < WIDTH; ++x) add_pixel(x, y);
  }

  void add_pixel(std::uint32_t x, std::uint32_t y) {
    const bool near = x > 90 && x<150, seen = y> 8 && x < 270 && below(1.0F) > 0.03F;
    AovPixel pixel{};
    pixel.object = seen ? (near ? 1U : 0U) : NO_OBJECT;
    pixel.normal = seen ? glm::normalize(vec3(near ? 0.5F : 0.0F, 0.1F, 1.0F)) : vec3(0.0F);
    pixel.z = seen ? (near ? 2.0F : 3.0F) + 0.01F * float(x) + below(1e-3F) : INFINITY;
    image.aov.push_back(pixel);
    const vec3 paint =
        !seen ? vec3(0.0F) : (x / 20 % 2 == 0 ? vec3(0.8F, 0.4F, 0.1F) : vec3(0.02F, 0.3F, 0.9F));
    base.emplace_back(paint, seen ? 1.0F : 0.0F);
    const float light = 0.2F + 0.01F * float(y);
    const vec3 sky(0.1F, 0.2F, 0.4F);
    const auto sample = [&] {
      const float spark = below(1.0F) < 0.01F ? 40.0F : 1.0F;
      return seen ? paint * light * spark * (0.5F + below(1.0F)) : sky;
    };
    const vec3 part = sample(), rest = sample();
    image.part.emplace_back(part, seen ? 1.0F : 0.0F);
    image.rgba.emplace_back(glm::mix(rest, part, image.part_share), seen ? 1.0F : 0.0F);
  }
  float below(float most) { return std::uniform_real_distribution<float>(0.0F, most)(random); }
  std::size_t any_pixel() { return random() % (WIDTH * HEIGHT); }
  float poison() {
    constexpr float POISONS[] = {INFINITY, -INFINITY, std::numeric_limits<float>::quiet_NaN(),
                                 0.0F,     -0.0F,     1e-40F};
    return POISONS[random() % std::size(POISONS)];
  }
};

class DeviceFilterTest : public DeviceTest {
 protected:
  VulkanBuffer on_device(std::span<const std::byte> bytes) {
    VulkanBuffer buffer(device, bytes.size(), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
    queue.upload(buffer, bytes);
    return buffer;
  }

  std::vector<vec4> filtered(const NoisyImage& noisy, float weight = 1.0F,
                             const std::vector<vec4>& before = {}) {
    const Image& image = noisy.image;
    const VulkanBuffer means = on_device(std::as_bytes(std::span(image.rgba)));
    const VulkanBuffer first = on_device(std::as_bytes(std::span(before.empty() ? image.rgba : before)));
    const VulkanBuffer part = on_device(std::as_bytes(std::span(image.part)));
    const VulkanBuffer base = on_device(std::as_bytes(std::span(noisy.base)));
    const VulkanBuffer aov = on_device(std::as_bytes(std::span(image.aov)));
    filter.keep({image.width, image.height, &part, &part});
    const VulkanBuffer& result =
        filter.run({image.width, image.height, &means, &first, weight}, image.part_share, base, aov);
    std::vector<vec4> pixels(image.rgba.size());
    filter.wait();
    queue.download(result, std::as_writable_bytes(std::span(pixels)));
    return pixels;
  }

  /// By how much of a channel, at most.
  static double most_apart(const std::vector<vec4>& a, const std::vector<vec4>& b) {
    double most = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
      for (int channel = 0; channel < 4; ++channel) {
        const double x = a[i][channel], y = b[i][channel];
        const double apart = std::abs(x - y) / std::max({std::abs(x), std::abs(y), DARK});
        most = std::max(most, std::isfinite(x) ? apart : INFINITY);
      }
    return most;
  }

  CommandQueue queue{device};
  DeviceFilter filter{device};
};

TEST_F(DeviceFilterTest, GivesThePictureThatTheHostGives) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const NoisyImage noisy(seed);
    const std::vector<vec4> host = denoised(noisy.image, noisy.base).rgba;
    EXPECT_LE(most_apart(filtered(noisy), host), BOUND) << seed;
    EXPECT_GT(most_apart(noisy.image.rgba, host), 0.1) << "it does something";
  }
}

/// The picture as the tracer has it that has traced many samples.
TEST_F(DeviceFilterTest, JoinsTheSamplesThatWereBefore) {
  NoisyImage noisy(4);
  const std::vector<vec4> host = denoised(noisy.image, noisy.base).rgba;
  std::vector<vec4> before = noisy.image.rgba;
  for (std::size_t i = 0; i < before.size(); ++i) {
    before[i] *= vec4(0.5F, 1.5F, 1.0F, 1.0F);
    noisy.image.rgba[i] = (noisy.image.rgba[i] - 0.75F * before[i]) / 0.25F;
  }
  EXPECT_LE(most_apart(filtered(noisy, 0.25F, before), host), BOUND);
  std::fill(noisy.image.rgba.begin(), noisy.image.rgba.end(), vec4(std::nanf("")));
  EXPECT_LE(most_apart(filtered(noisy, 0.0F, NoisyImage(4).image.rgba), host), BOUND)
      << "none is in the last mean yet";
}

TEST_F(DeviceFilterTest, EveryInputMayHoldAnything) {
  const std::vector<std::pair<const char*, std::function<void(NoisyImage&, std::size_t)>>> ways = {
      {"colour", [](NoisyImage& p, std::size_t i) { p.image.rgba[i][int(p.random() % 3)] = p.poison(); }},
      {"coverage", [](NoisyImage& p, std::size_t i) { p.image.rgba[i].w = p.poison(); }},
      {"half", [](NoisyImage& p, std::size_t i) { p.image.part[i][int(p.random() % 4)] = p.poison(); }},
      {"base", [](NoisyImage& p, std::size_t i) { p.base[i][int(p.random() % 4)] = p.poison(); }},
      {"normal",
       [](NoisyImage& p, std::size_t i) { p.image.aov[i].normal[int(p.random() % 3)] = p.poison(); }},
      {"depth", [](NoisyImage& p, std::size_t i) { p.image.aov[i].z = p.poison(); }},
      {"no variance", [](NoisyImage& p, std::size_t i) { p.image.part[i] = p.image.rgba[i]; }}};
  NoisyImage all(1);
  for (const auto& [name, poison] : ways) {
    NoisyImage one(1);
    for (int times = 0; times < 60; ++times) {
      poison(one, one.any_pixel());
      poison(all, all.any_pixel());
    }
    EXPECT_LE(most_apart(filtered(one), denoised(one.image, one.base).rgba), BOUND) << name;
  }
  EXPECT_LE(most_apart(filtered(all), denoised(all.image, all.base).rgba), BOUND) << "all";
}

}  // namespace
}  // namespace splatray
