// Many lights: as many dispatches as the device needs, and the picture of one.
#include <gtest/gtest.h>

#include <algorithm>

#include "data/shapes.h"
#include "engine/base/error.h"
#include "engine/device/vulkan/vulkan_device.h"
#include "engine/scene/environment.h"
#include "tests/all_tests.h"
#include "tests/gpu/shown_tracer.h"
#include "tests/trace/scenes.h"

namespace splatray::testing {
namespace {

Scene ball_scene(std::uint32_t flags, float mirror = 0.0F) {
  Material material = test_material(flags);
  material.phong.mirror = mirror;
  material.phong.specular = 0.3F;
  material.phong.shininess = 20.0F;
  return scene_of({{sphere({.count = 2000, .even = true, .seed = 3}, 1.0), material}});
}

/// The scene's picture under `suns` suns from one direction that share the power of one.
class SharedSun {
 public:
  explicit SharedSun(const Scene& scene) : scene_(scene), camera_(default_camera(scene, 1.0)) {
    tracer_.upload(scene);
    tracer_.set_environment(studio_environment());
  }

  std::vector<vec4> picture(std::uint32_t suns, Settings settings, std::uint32_t edge = 24) {
    const SceneLight sun{LIGHT_DIRECTIONAL, glm::normalize(glm::dvec3(0.5, 1.0, 0.4)),
                         glm::vec3(3.0F / float(suns))};
    tracer_.look.lights = std::vector<SceneLight>(suns, sun);
    return tracer_.render({camera_, edge, edge}, settings).rgba;
  }

  /// The largest difference of a channel, coverage included, to the picture of one sun.
  double difference(std::uint32_t suns, const Settings& settings, std::uint32_t edge = 24) {
    const std::vector<vec4> one = picture(1, settings, edge), many = picture(suns, settings, edge);
    double most = 0.0;
    for (std::size_t i = 0; i < one.size(); ++i) {
      const vec4 apart = glm::abs(one[i] - many[i]);
      most = std::max(most, double(std::max(std::max(apart.x, apart.y), std::max(apart.z, apart.w))));
    }
    return most;
  }

  ShownTracer& tracer() { return tracer_; }

 private:
  const Scene scene_;
  const Camera camera_;
  VulkanDevice device_;
  ShownTracer tracer_{device_};
};

/// Sums of 4000 float32 numbers differ from the whole by their rounding.
constexpr double ROUNDING = 2e-4;

TEST(Lights, SunsThatShareThePowerOfOneMakeItsPicture) {
  SharedSun scene(ball_scene(MATERIAL_TWO_SIDED));
  Settings settings;
  for (const std::uint32_t samples : {1U, 16U}) {
    settings.samples = samples;
    for (const std::uint32_t suns : {7U, 8U, 128U, 200U})
      EXPECT_LT(scene.difference(suns, settings), ROUNDING) << suns << " suns, " << samples << " samples";
  }
  settings.samples = 1;
  for (const std::uint32_t suns : {2000U, 4000U})
    EXPECT_LT(scene.difference(suns, settings, 8), ROUNDING) << suns << " suns";
}

TEST(Lights, MirrorsAndGlassShowManyToo) {
  Settings settings;
  settings.samples = 4;
  SharedSun mirror(ball_scene(MATERIAL_TWO_SIDED, 0.5F)), glass(ball_scene(MATERIAL_DIELECTRIC));
  EXPECT_LT(mirror.difference(300, settings), ROUNDING);
  EXPECT_LT(glass.difference(300, settings), ROUNDING);
  settings.max_bounces = 64;
  EXPECT_LT(mirror.difference(50, settings), ROUNDING);
}

TEST(Lights, RaysAreCountedOnceHoweverManyDispatchesALightTakes) {
  SharedSun scene(ball_scene(MATERIAL_TWO_SIDED, 0.5F));
  Settings settings;
  settings.samples = 2;
  settings.counters = true;
  (void)scene.picture(1, settings);
  const RenderStats one = scene.tracer().stats();
  (void)scene.picture(300, settings);
  const RenderStats many = scene.tracer().stats();
  for (const std::uint32_t counter :
       {COUNT_PRIMARY, COUNT_HITS, COUNT_REFLECTED, COUNT_BOUNCE_LIMIT, COUNT_ENERGY_LOST})
    EXPECT_EQ(one.counters[counter], many.counters[counter]) << counter;
  EXPECT_EQ(300 * one.counters[COUNT_SHADOW], many.counters[COUNT_SHADOW]);
}

TEST(Lights, MoreThanTheBoundAreRefused) {
  SharedSun scene(ball_scene(0));
  static_cast<void>(scene.picture(LIGHTS_MOST, {.samples = 1}, 1));
  try {
    static_cast<void>(scene.picture(LIGHTS_MOST + 1, {.samples = 1}, 1));
    FAIL() << "4097 lights were taken";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("found 4097 lights, expected at most 4096"), std::string::npos);
  }
}

/// Shadow rays of a picture of the scene under one sun.
std::uint64_t shadow_rays(const Scene& scene) {
  SharedSun shown(scene);
  Settings settings;
  settings.samples = 4;
  settings.counters = true;
  (void)shown.picture(1, settings);
  return shown.tracer().stats().counters[COUNT_SHADOW];
}

TEST(Lights, NoShadowRayIsTracedWhoseLightIsMultipliedByZero) {
  Scene scene = ball_scene(MATERIAL_TWO_SIDED);
  const std::uint64_t matte = shadow_rays(scene);
  EXPECT_GT(matte, 0U);
  scene.materials[0].phong.mirror = 1.0F;
  EXPECT_EQ(shadow_rays(scene), 0U) << "a full mirror";
  scene.materials[0].phong.mirror = 0.5F;
  EXPECT_GE(shadow_rays(scene), matte) << "half a mirror";
  scene.materials[0].phong.mirror = 0.0F;
  scene.materials[0].phong.diffuse = glm::vec3(0.0F);
  EXPECT_EQ(shadow_rays(scene), matte) << "a highlight";
  scene.materials[0].phong.specular = 0.0F;
  EXPECT_EQ(shadow_rays(scene), 0U) << "black";
  Scene glass = ball_scene(MATERIAL_DIELECTRIC);
  EXPECT_GT(shadow_rays(glass), 0U) << "glass with a highlight";
  glass.materials[0].phong.specular = 0.0F;
  EXPECT_EQ(shadow_rays(glass), 0U) << "clear glass";
}

TEST(Lights, OnlyTheMaterialThatScattersTracesShadowRays) {
  Material gold = test_material(MATERIAL_TWO_SIDED), matte = test_material(MATERIAL_TWO_SIDED);
  gold.phong.mirror = 1.0F;
  auto apart = sphere({.count = 2000, .even = true, .seed = 3}, 1.0);
  for (glm::dvec3& position : apart.position) position.x += 2.5;
  const auto near = sphere({.count = 2000, .even = true, .seed = 4}, 1.0);
  const std::uint64_t both = shadow_rays(scene_of({{near, matte}, {apart, matte}}));
  const std::uint64_t one = shadow_rays(scene_of({{near, matte}, {apart, gold}}));
  EXPECT_GT(one, both / 4);
  EXPECT_LT(one, both);
}

}  // namespace
}  // namespace splatray::testing
