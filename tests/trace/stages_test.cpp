/// Pictures are the same whether paths are traced in stages or each to its end at once.
#include <gtest/gtest.h>

#include "data/shapes.h"
#include "engine/device/vulkan/vulkan_device.h"
#include "tests/gpu/shown_tracer.h"
#include "tests/trace/different_bits.h"
#include "tests/trace/scenes.h"

namespace splatray::testing {
namespace {

TestObject ball(const glm::dvec3& center, const Material& material) {
  TestObject object{sphere({.count = 3000, .even = true, .seed = 3}, 1.0), material};
  for (glm::dvec3& position : object.points.position) position += center;
  return object;
}

class Stages : public ::testing::Test {
 protected:
  Stages() {
    Material mirror = test_material(0);
    mirror.phong.mirror = 0.8F;
    Scene scene = scene_of({ball({0, 0, 0}, test_material(MATERIAL_DIELECTRIC)), ball({2.2, 0, 0}, mirror),
                            ball({1, 2, 0}, test_material(MATERIAL_TWO_SIDED))});
    camera = default_camera(scene, 1.5);
    scene.lights = default_lights(scene, camera);
    tracer.upload(scene);
    tracer.set_environment(studio_environment());
    skipped = !device.profile().stages;
  }

  void SetUp() override {
    if (skipped) GTEST_SKIP() << "this device traces paths at once";
  }

  /// Expects the same bits and the same rays.
  void expect_same(const View& view, Settings settings) {
    settings.counters = true;
    settings.stages = false;
    const Image whole = tracer.render(view, settings);
    const RenderStats at_once = tracer.stats();
    settings.stages = true;
    const Image staged = tracer.render(view, settings);
    RenderStats in_stages = tracer.stats();
    EXPECT_EQ(different_bits(whole.rgba, staged.rgba), 0U);
    EXPECT_EQ(at_once.counters[COUNT_QUEUED], 0U);
    EXPECT_EQ(in_stages.counters[COUNT_QUEUED],
              in_stages.counters[COUNT_REFLECTED] + in_stages.counters[COUNT_REFRACTED]);
    EXPECT_GT(in_stages.counters[COUNT_REFRACTED], 0U);
    in_stages.counters[COUNT_QUEUED] = 0;
    EXPECT_EQ(in_stages.counters, at_once.counters);
  }

  VulkanDevice device;
  ShownTracer tracer{device};
  Camera camera;
  bool skipped = false;
};

TEST_F(Stages, ChangeNoPicture) {
  expect_same({camera, 203, 131}, {.samples = 3});
  expect_same({camera, 203, 131}, {.samples = 1, .order = ORDER_LINEAR});
  expect_same({camera, 61, 40}, {.samples = 2, .max_bounces = 2});
  expect_same({camera, 61, 40},
              {.samples = 1, .max_bounces = 64, .shadows = false, .side = SIDE_DELTA, .delta_world = 0.01});
}

TEST_F(Stages, ChangeNoPictureOfMoreThanOneQueue) {
  Camera near = camera;
  near.fov_y_deg = 12.0;
  expect_same({near, 640, 520}, {.samples = 1});
}

TEST_F(Stages, ChangeNoGrowingPicture) {
  const View view{camera, 203, 131};
  std::vector<std::vector<vec4>> pictures;
  for (const bool stages : {false, true}) {
    tracer.begin(view, {.samples = 2, .stages = stages});
    while (!tracer.advance(1.0)) continue;
    pictures.push_back(tracer.picture().rgba);
  }
  EXPECT_EQ(different_bits(pictures[0], pictures[1]), 0U);
}

TEST_F(Stages, AreNotForScenesWithoutDielectrics) {
  Scene scene = scene_of({ball({0, 0, 0}, test_material(0))});
  tracer.upload(scene);
  static_cast<void>(tracer.render({camera, 61, 40}, {.samples = 1, .counters = true}));
  const std::uint32_t built = tracer.pipelines_built();
  static_cast<void>(tracer.render({camera, 61, 40}, {.samples = 1, .stages = false, .counters = true}));
  EXPECT_EQ(tracer.pipelines_built(), built);
}

}  // namespace
}  // namespace splatray::testing
