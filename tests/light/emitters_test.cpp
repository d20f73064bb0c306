// Light that objects send out: where it is looked for, and that it is all found, against closed forms and against chance.
#include "engine/light/emitters.h"

#include <gtest/gtest.h>

#include "engine/scene/splat.h"
#include "tests/light/lit.h"

namespace splatray::testing {
namespace {

/// The last object sends out this radiance.
Scene glowing(const std::vector<TestObject>& objects, const vec3& radiance) {
  Scene scene = scene_of(objects);
  scene.materials.back().emission = radiance;
  return scene;
}

TEST(Emitters, OnlyOfWhatIsSeenAndSendsOutLight) {
  Scene scene = glowing({{ball_at({}, 1.0, 50), grey(0.5F)}, {ball_at({3.0, 0.0, 0.0}, 0.1, 50), grey(0.5F)}},
                        vec3(1.0F));
  EXPECT_EQ(find_emitters(scene, scene.materials)->size(), 50U);
  scene.materials.back().flags |= MATERIAL_HIDDEN;
  EXPECT_EQ(find_emitters(scene, scene.materials), nullptr);
}

TEST(Emitters, EachOnce) {
  Scene scene = glowing({{ball_at({}, 1.0, 50), grey(0.5F)}}, vec3(1.0F));
  scene.data_pool.edit().push_back(scene.data_pool.front());
  EXPECT_EQ(find_emitters(scene, scene.materials)->size(), 50U);
}

/// A lamp above a plane.
class Lamp : public Plane {
 protected:
  static constexpr double RADIUS = 0.2, RADIANCE = 10.0;
  static constexpr dvec3 CENTER{0.5, 1.0, 0.0};

  /// Its irradiance at the plane's middle.
  static double truth() {
    const double distance = glm::length(CENTER);
    return pi * RADIANCE * RADIUS * RADIUS / (distance * distance) * CENTER.y / distance;
  }
  void show_lamp(const Environment& environment, const std::vector<SceneLight>& lights) {
    show(glowing({floor(), {ball_at(CENTER, RADIUS, 4000), grey(0.0F)}}, vec3(float(RADIANCE))), environment,
         lights);
  }
};

TEST_F(Lamp, GivesWhatItShould) {
  show_lamp(constant(0.0F), {});
  const Mean found = irradiance_shown(1024);
  // Splats of a ball of 4000 stand out by less than a thousandth of its radius.
  EXPECT_NEAR(found.value, truth(), 3e-3 * truth() + 3.0 * found.error);
  EXPECT_LT(found.error, 5e-3 * truth());
}

TEST_F(Lamp, GivesTheSameWhateverItsColour) {
  OrientedPoints points = ball_at(CENTER, RADIUS, 4000), white_floor = floor().points;
  points.color.assign(points.position.size(), dvec3(20.0 / 255.0, 0.0, 0.0));
  white_floor.color.assign(white_floor.position.size(), dvec3(1.0));
  show(glowing({{white_floor, grey(1.0F)}, {points, grey(0.0F)}}, vec3(float(RADIANCE))), constant(0.0F), {});
  const Mean found = irradiance_shown(1024);
  EXPECT_NEAR(found.value, truth(), 3e-3 * truth() + 3.0 * found.error);
}

TEST_F(Lamp, IsLookedFor) {
  show_lamp(constant(0.0F), {});
  const Mean sampled = irradiance_shown(256);
  tracer_.look.emitters = {};
  const Mean by_chance = irradiance_shown(256);
  EXPECT_LT(5.0 * sampled.error, by_chance.error);
  EXPECT_NEAR(by_chance.value, truth(), 4.0 * by_chance.error);
}

/// The sum of each: no light counts twice or is missed where several ways find it.
TEST_F(Lamp, BesideOtherLights) {
  SceneLight light{LIGHT_POINT, {-0.5, 1.2, 0.3}, vec3(2.0F)};
  light.size = 0.3;
  const Environment sky{64, 32, std::vector<glm::vec3>(64 * 32, vec3(0.25F)), vec3(0.0F)};
  const Mean others = irradiance({light}, 1024, sky);
  show_lamp(sky, {light});
  const Mean all = irradiance_shown(1024);
  // The lamp, black but for its light, hides a part of the sky: as much as it would light at that radiance.
  const double expected = others.value + truth() * (1.0 - 0.25 / RADIANCE);
  EXPECT_NEAR(all.value, expected, 3e-3 * expected + 3.0 * (all.error + others.error));
}

TEST_F(Lamp, OverAMirrorWithAMatteBase) {
  Scene scene = glowing({floor(), {ball_at(CENTER, RADIUS, 4000), grey(0.0F)}}, vec3(float(RADIANCE)));
  scene.materials.front().specular = 1.0F;
  scene.materials.front().roughness = 0.0F;
  show(scene, constant(0.0F), {});
  const Mean sampled = irradiance_shown(1024);
  tracer_.look.emitters = {};
  const Mean by_chance = irradiance_shown(4096);
  EXPECT_NEAR(sampled.value, by_chance.value, 3.0 * (sampled.error + by_chance.error));
}

}  // namespace
}  // namespace splatray::testing
