// What a ray and a splat cost, by counters, which the machine's noise does not touch: more fails, and much less asks for the
// new figures here, so that they stay what is known.
#include <gtest/gtest.h>

#include <iostream>

#include "data/shapes.h"
#include "engine/device/vulkan/vulkan_device.h"
#include "tests/gpu/shown_tracer.h"
#include "tests/trace/scenes.h"

namespace splatray::testing {
namespace {

/// Of rays of all kinds, and bytes of all pools but the top table, which is the same for every scene.
struct Work {
  double tests_per_ray;
  double node_words_per_ray;
  double leaves_per_ray;
  double bytes_per_splat;
};

Work work_of(const Device& device, Scene scene) {
  Settings settings;
  settings.samples = 1;
  settings.counters = true;
  const View view{default_camera(scene, 1.0), 256, 256};
  if (scene.lights.empty()) scene.lights = default_lights(scene, view.camera);
  ShownTracer tracer(device);
  tracer.upload(scene);
  static_cast<void>(tracer.render(view, settings));
  const auto& count = tracer.stats().counters;
  const auto rays = double(tracer.stats().rays());
  const std::uint64_t pools = total_bytes(tracer.pool_bytes()) - tracer.pool_bytes().at(BIND_TOP_TABLE);
  return {double(count[COUNT_TESTS]) / rays, double(count[COUNT_NODE_STEPS]) / rays,
          double(count[COUNT_LEAVES]) / rays, double(pools) / double(scene.data_pool.size())};
}

void expect_near(double measured, double known, const char* what) {
  EXPECT_LE(measured, 1.02 * known) << what << ": worse than known";
  EXPECT_GE(measured, 0.9 * known) << what << ": better; note the new figure";
}

void expect_near(const Work& measured, const Work& known) {
  std::cout << measured.tests_per_ray << " tests, " << measured.node_words_per_ray << " node words, "
            << measured.leaves_per_ray << " leaves a ray; " << measured.bytes_per_splat << " bytes a splat\n";
  expect_near(measured.tests_per_ray, known.tests_per_ray, "splat tests per ray");
  expect_near(measured.node_words_per_ray, known.node_words_per_ray, "node words per ray");
  expect_near(measured.leaves_per_ray, known.leaves_per_ray, "leaves per ray");
  expect_near(measured.bytes_per_splat, known.bytes_per_splat, "bytes per splat");
}

void expect_work(const Scene& scene, const Work& known) {
  const VulkanDevice device;
  expect_near(work_of(device, scene), known);
}

TestObject ball(bool even, std::uint32_t flags) {
  return {sphere({.count = 100000, .even = even, .seed = 7}, 1.0), test_material(flags)};
}

TEST(Work, EvenSphere) { expect_work(scene_of({ball(true, 0)}), {10.7, 8.77, 6.02, 49.8}); }
TEST(Work, EvenSphereInLargeLeaves) { expect_work(scene_of({ball(true, 0)}, 40), {25.6, 5.06, 4.98, 33.9}); }
TEST(Work, RandomSphere) { expect_work(scene_of({ball(false, 0)}), {19.5, 7.93, 5.92, 60.5}); }

TEST(Work, LayersOfAColoredScan) {
  TestObject scan{{}, test_material(MATERIAL_TWO_SIDED)};
  for (const double radius : {1.0, 1.01, 1.02})
    append(scan.points,
           painted(sphere({.count = 30000, .even = false, .seed = std::uint64_t(1000 * radius)}, radius),
                   [](glm::dvec3 at) { return 0.5 + 0.4 * at; }));
  expect_work(scene_of({scan}), {70.8, 9.85, 6.82, 57.6});
}

TEST(Work, GlassBallInARoom) {
  TestObject room{{}, test_material(0)};
  for (const SurfacePatch& face : box("room", glm::dvec3(4.0), true))
    append(room.points, face.make({.count = 20000}));
  expect_work(scene_of({room, ball(true, MATERIAL_DIELECTRIC)}), {17.1, 18.0, 10.0, 51.1});
}

}  // namespace
}  // namespace splatray::testing
