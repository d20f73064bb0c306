/// Pictures are the same whether what no leaf projects to is traced or not.
#include <gtest/gtest.h>

#include "data/shapes.h"
#include "engine/device/vulkan/vulkan_device.h"
#include "tests/gpu/shown_tracer.h"
#include "tests/trace/different_bits.h"
#include "tests/trace/scenes.h"

namespace splatray::testing {
namespace {

class Culling : public ::testing::Test {
 protected:
  Culling() {
    const OrientedPoints ball = sphere({.count = 5000, .even = true, .seed = 3}, 1.0);
    OrientedPoints other = ball;
    for (glm::dvec3& position : other.position) position += glm::dvec3(4.0, 3.0, -2.0);
    Scene balls = scene_of({{ball, test_material(0)}, {other, test_material(MATERIAL_TWO_SIDED)}});
    camera = default_camera(balls, 1.5);
    balls.lights = default_lights(balls, camera);
    tracer.upload(balls);
    tracer.set_environment(studio_environment());
  }

  /// Expects the same bits with and without.
  void expect_same(const View& view, Settings settings) {
    settings.counters = true;
    settings.cull = false;
    const Image whole = tracer.render(view, settings);
    const RenderStats all = tracer.stats();
    const std::vector<AovPixel> whole_aov = tracer.trace_aov(view, {.cull = false});
    settings.cull = true;
    const Image culled = tracer.render(view, settings);
    const RenderStats less = tracer.stats();
    EXPECT_EQ(different_bits(whole.rgba, culled.rgba), 0U);
    EXPECT_EQ(different_bits(whole_aov, tracer.trace_aov(view, {})), 0U);
    EXPECT_EQ(less.counters[COUNT_PRIMARY], all.counters[COUNT_PRIMARY]);
    EXPECT_EQ(less.counters[COUNT_HITS], all.counters[COUNT_HITS]);
    EXPECT_EQ(less.counters[COUNT_SHADOW], all.counters[COUNT_SHADOW]);
    leaves += all.counters[COUNT_LEAVES];
    culled_leaves += less.counters[COUNT_LEAVES];
  }

  VulkanDevice device;
  ShownTracer tracer{device};
  Camera camera;
  std::uint64_t leaves = 0, culled_leaves = 0;  ///< visited in all pictures of expect_same, without and with
};

TEST_F(Culling, ChangesNoPicture) {
  expect_same({camera, 203, 131}, {.samples = 3});
  expect_same({camera, 203, 131}, {.samples = 1, .order = ORDER_LINEAR});
  Camera near = camera;
  near.eye = near.target + 0.5 * (near.eye - near.target);
  near.target += glm::cross(near.target - near.eye, near.up);
  expect_same({near, 203, 131}, {.samples = 1});
  camera.ortho_height = 7.0;
  expect_same({camera, 203, 131}, {.samples = 1});
  if (device.is_cpu()) {
    EXPECT_LT(culled_leaves, leaves);
  }
}

TEST_F(Culling, ChangesNoGrowingPicture) {
  const View view{camera, 203, 131};
  std::vector<std::vector<vec4>> pictures;
  for (const bool cull : {false, true}) {
    tracer.begin(view, {.samples = 2, .cull = cull});
    while (!tracer.advance(1.0)) continue;
    pictures.push_back(tracer.picture().rgba);
  }
  EXPECT_EQ(different_bits(pictures[0], pictures[1]), 0U);
}

}  // namespace
}  // namespace splatray::testing
