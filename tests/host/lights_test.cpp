#include <gtest/gtest.h>

#include <numbers>

#include "engine/image/view.h"
#include "tests/host/scenes.h"

namespace splatray {
namespace {

TEST(LightsInRoot, PointKeepsItsIrradiance) {
  const Scene scene = box_scene({1e6, 2e6, 0.0});
  SceneLight lamp;
  lamp.kind = LIGHT_POINT;
  lamp.position = glm::dvec3(1e6 + 0.5, 2e6, 0.25);
  lamp.power = glm::vec3(3.0F, 2.0F, 1.0F);
  const Light light = lights_in_root(scene, {lamp}).front();
  EXPECT_EQ(light.kind, LIGHT_POINT);
  EXPECT_LT(glm::length(scene.root.to_world(glm::dvec3(light.position)) - lamp.position), 1e-6);
  const double distance_root = 2.0 / scene.root.unit_world;
  EXPECT_NEAR(light.power.x / (distance_root * distance_root), 3.0 / 4.0, 1e-5);
}

TEST(LightsInRoot, DirectionalBecomesUnit) {
  SceneLight sun;
  sun.position = {0.0, 3.0, 4.0};
  const Light light = lights_in_root(box_scene(), {sun}).front();
  EXPECT_LT(glm::length(light.position - glm::vec3(0.0F, 0.6F, 0.8F)), 1e-6F);
  EXPECT_EQ(light.power, sun.power);
}

TEST(LightsInRoot, SpotsAndTheirRange) {
  const Scene scene = box_scene();
  SceneLight spot{.kind = LIGHT_POINT, .position = {0.0, 2.0, 0.0}};
  spot.spot_axis = {0.0, -3.0, 0.0};
  spot.spot_inner = 0.2;
  spot.spot_outer = 0.5;
  spot.range = 4.0;
  const Light light = lights_in_root(scene, {spot}).front();
  EXPECT_EQ(light.spot_axis, glm::vec3(0.0F, -1.0F, 0.0F));
  EXPECT_NEAR(light.spot_cosine, std::cos(0.5), 1e-6);
  EXPECT_NEAR(light.spot_scale, 1.0 / (std::cos(0.2) - std::cos(0.5)), 1e-5);
  EXPECT_NEAR(light.range_scale * std::pow(4.0 / scene.root.unit_world, 4.0), 1.0, 1e-5);
  EXPECT_EQ(lights_in_root(scene, {SceneLight{}}).front().spot_scale, 0.0F);
}

TEST(DefaultLights, ComeOverTheViewersLeftShoulder) {
  const Scene scene = box_scene();
  Camera camera;
  camera.eye = {0.0, 0.0, 5.0};
  const auto lights = default_lights(scene, camera);
  ASSERT_EQ(lights.size(), 1U);
  EXPECT_EQ(lights[0].kind, LIGHT_DIRECTIONAL);
  EXPECT_NEAR(glm::length(lights[0].position), 1.0, 1e-12);
  EXPECT_LT(lights[0].position.x, -0.3);
  EXPECT_NEAR(lights[0].position.y, std::sqrt(0.5), 1e-12);
  EXPECT_GT(lights[0].position.z, 0.3);
}

TEST(DefaultLights, SurviveAViewFromAbove) {
  Camera camera;
  camera.eye = {0.0, 5.0, 0.0};
  camera.up = {0.0, 0.0, -1.0};
  EXPECT_NEAR(glm::length(default_lights(box_scene(), camera)[0].position), 1.0, 1e-12);
}

TEST(OwnLights, AreAsStrongTogetherAsTheirIrradianceInTheMiddle) {
  Scene scene = box_scene();
  SceneLight sun, lamp;
  sun.power = glm::vec3(5.0F);
  lamp.kind = LIGHT_POINT;
  lamp.position = {0.0, 20.0, 0.0};
  lamp.power = glm::vec3(1200.0F, 0.0F, 0.0F);
  lamp.spot_axis = {1.0, 0.0, 0.0};
  lamp.spot_outer = 0.1;
  lamp.range = 3.0;
  scene.lights = {sun, lamp};
  const glm::dvec3 middle = 0.5 * (scene.bounds_min_world + scene.bounds_max_world);
  const double distance = glm::length(lamp.position - middle);
  EXPECT_NEAR(own_light_level(scene), 5.0 + 400.0 / (distance * distance), 1e-9);
  scene.lights = {lamp};
  scene.lights[0].position = middle;
  const double quarter = 0.25 * scene.diagonal_world();
  EXPECT_NEAR(own_light_level(scene), 400.0 / (quarter * quarter), 1e-9)
      << "a lamp is not taken to be nearer";
  for (SceneLight& light : scene.lights) light.power *= 1e4F;
  EXPECT_NEAR(own_light_level(scene), 4e6 / (quarter * quarter), 1e-3);
}

}  // namespace
}  // namespace splatray
