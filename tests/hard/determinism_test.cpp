// The same input gives the same bytes: again, with other numbers of threads, in the other order of pixels, from
// shuffled points, and with other leaves.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>

#include "data/shapes.h"
#include "engine/device/vulkan/vulkan_device.h"
#include "tests/all_tests.h"
#include "tests/hard/support/clouds.h"
#include "tests/hard/support/device_scene.h"
#include "tests/trace/rays.h"

namespace splatray::testing {
namespace {

/// A glass sphere beside a mirror sphere on a floor, under a light; its points in an order that `seed` chooses.
Scene some_of_everything(std::uint32_t leaf_size = 10, std::uint64_t seed = 0) {
  OrientedPoints floor = rectangle({.count = 3000}, {-3, -1, 3}, {6, 0, 0}, {0, 0, -6});
  std::vector<TestObject> objects = {
      {floor, test_material(0)},
      {moved(sphere({.count = 3000}, 1.0), {-1.1, 0, 0}), glass_material(1.5F)},
      {moved(sphere({.count = 3000}, 1.0), {1.1, 0, 0}), mirror_material()}};
  std::mt19937_64 random(seed);
  for (TestObject& object : objects) {
    std::vector<std::size_t> order(object.points.position.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    if (seed > 0) std::shuffle(order.begin(), order.end(), random);
    const OrientedPoints source = object.points;
    for (std::size_t i = 0; i < order.size(); ++i) {
      object.points.position[i] = source.position[order[i]];
      object.points.normal[i] = source.normal[order[i]];
    }
  }
  Scene scene = scene_of(objects, leaf_size);
  scene.lights = {{LIGHT_POINT, {2.0, 4.0, 3.0}, vec3(30.0F)}};
  return scene;
}

Image picture_of(DeviceScene& device, std::uint32_t order = ORDER_Z) {
  Settings settings;
  settings.samples = 4;
  settings.order = order;
  return device.render({{.eye = {0.0, 1.5, 6.0}}, hard_width(161), hard_width(93)}, settings,
                       studio_environment());
}

/// Compares a picture with the scene's own.
CaseRow compare_pixels(DeviceScene& device, const Image& expected, const Image& found,
                       const std::string& compared) {
  CaseRow row = device.row(compared);
  row.count = expected.rgba.size();
  row.unit = "pixels";
  row.exceptions = different_bits(expected.rgba, found.rgba);
  return row;
}

TEST(Determinism, TenRuns) {
  DeviceScene device(some_of_everything());
  const Image first = picture_of(device);
  CaseRow all = device.row("bits of pixels, 9 further runs");
  all.unit = "pixels";
  for (int run = 0; run < 9; ++run) {
    const CaseRow row = compare_pixels(device, first, picture_of(device), "");
    all.count += row.count;
    all.exceptions += row.exceptions;
  }
  conclude(all);
}

TEST(Determinism, BothPixelOrders) {
  DeviceScene device(some_of_everything());
  const Image z_order = picture_of(device);
  conclude(
      compare_pixels(device, z_order, picture_of(device, ORDER_LINEAR), "bits of pixels, Z order and rows"));
}

TEST(Determinism, ShuffledInput) {
  DeviceScene device(some_of_everything());
  const Image expected = picture_of(device);
  for (const std::uint64_t seed : {1U, 2U}) {
    DeviceScene shuffled(some_of_everything(10, seed));
    conclude(compare_pixels(shuffled, expected, picture_of(shuffled),
                            "bits of pixels, points shuffled with seed " + std::to_string(seed)));
  }
}

TEST(Determinism, LeafSizes) {
  SPLATRAY_NIGHTLY();
  DeviceScene device(some_of_everything(10));
  const Image expected = picture_of(device);
  for (const std::uint32_t leaf_size : {4U, 40U}) {
    DeviceScene other(some_of_everything(leaf_size));
    conclude(compare_pixels(other, expected, picture_of(other),
                            "bits of pixels, leaf sizes 10 and " + std::to_string(leaf_size)));
  }
}

/// Threads of this process whose name says that lavapipe draws with them.
std::size_t lavapipe_threads() {
  std::size_t threads = 0;
  for (const auto& task : std::filesystem::directory_iterator("/proc/self/task")) {
    std::string name;
    std::getline(std::ifstream(task.path() / "comm"), name);
    threads += name.rfind("llvmpipe-", 0) == 0 ? 1 : 0;
  }
  return threads;
}

/// The picture by a device of its own with this many threads (LP_NUM_THREADS, read when it is made).
Image picture_with_threads(std::size_t threads) {
  const std::size_t before = lavapipe_threads();
  setenv("LP_NUM_THREADS", std::to_string(threads).c_str(), 1);
  const VulkanDevice device;
  unsetenv("LP_NUM_THREADS");
  DeviceScene scene(some_of_everything(), device);
  Image image = picture_of(scene);
  EXPECT_EQ(lavapipe_threads() - before, threads);
  return image;
}

TEST(Determinism, OneAndTwoThreads) {
  if (shared_device().info().name.find("llvmpipe") == std::string::npos)
    GTEST_SKIP() << "the device is not lavapipe, whose threads can be chosen";
  const Image one = picture_with_threads(1);
  const Image two = picture_with_threads(2);
  const Image seven = picture_with_threads(7);
  CaseRow row{.compared = "bits of pixels, 1, 2 and 7 threads", .count = one.rgba.size(), .unit = "pixels"};
  row.exceptions = different_bits(one.rgba, two.rgba) + different_bits(one.rgba, seven.rgba);
  conclude(row);
}

TEST(Determinism, AnotherSeedIsNoticed) {
  DeviceScene device(some_of_everything());
  const Image first = picture_of(device);
  Settings settings;
  settings.samples = 4;
  settings.seed = 2;
  const Image other = device.render({{.eye = {0.0, 1.5, 6.0}}, hard_width(161), hard_width(93)}, settings,
                                    studio_environment());
  conclude_failing(compare_pixels(device, first, other, "bits of pixels, seeds 1 and 2"));
}

}  // namespace
}  // namespace splatray::testing
