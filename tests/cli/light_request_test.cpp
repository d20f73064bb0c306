/// Lights as they are asked for.
#include "app/library/request/light_request.h"

#include <gtest/gtest.h>

#include <numbers>

#include "app/library/request/fields.h"
#include "app/library/request/value_text.h"
#include "app/library/shot/lights.h"

namespace splatray {
namespace {

TEST(LightText, OneSpellingSaysAllOfEachKind) {
  const SceneLight spot =
      read_light("spot:at=0,3,0,to=0,1,0,cone=17,inner=5,range=9,power=4,5,6,radius=0.25").light;
  EXPECT_EQ(spot.kind, LIGHT_POINT);
  EXPECT_EQ(spot.position, glm::dvec3(0.0, 3.0, 0.0));
  EXPECT_EQ(spot.spot_axis, glm::dvec3(0.0, -1.0, 0.0));
  EXPECT_NEAR(spot.spot_outer, 17.0 * std::numbers::pi / 180.0, 1e-15);
  EXPECT_NEAR(spot.spot_inner, 5.0 * std::numbers::pi / 180.0, 1e-15);
  EXPECT_EQ(spot.range, 9.0);
  EXPECT_EQ(spot.power, glm::vec3(4.0F, 5.0F, 6.0F));
  EXPECT_EQ(spot.size, 0.25);
  const SceneLight sun = read_light("sun:from=1,2,3,angle=0.53").light;
  EXPECT_EQ(sun.kind, LIGHT_DIRECTIONAL);
  EXPECT_NEAR(sun.size, 0.53 * std::numbers::pi / 360.0, 1e-15);
  const SceneLight turned =
      read_light("rectangle:at=0,3,0,to=0,0,0,width=2,height=1,up=1,0,0,power=9,9,9").light;
  EXPECT_EQ(turned.kind, LIGHT_RECTANGLE);
  EXPECT_NEAR(glm::distance(turned.edge_v, glm::dvec3(0.5, 0.0, 0.0)), 0.0, 1e-15);
  EXPECT_NEAR(glm::distance(glm::cross(turned.edge_u, turned.edge_v), glm::dvec3(0.0, -0.5, 0.0)), 0.0,
              1e-15);
}

TEST(LightText, IsReadAgainAsItWas) {
  for (const char* text :
       {"point:at=1,2,3", "point:at=1,2,3,power=4,5,6,radius=0.5,range=7", "sun:from=0,0,1,angle=0.53",
        "spot:at=0,3,0,to=0,2,0,cone=17,inner=5,power=1,2,3,range=9", "spot:at=0,3,0,to=1,3,0,cone=90"}) {
    const LightRequest read = read_light(text);
    EXPECT_EQ(light_text(read), text);
    EXPECT_EQ(std::string(text).find(light_kind_name(read.light) + std::string(":")), 0U);
  }
  const LightRequest turned = read_light("rectangle:at=0,3,0,to=0,0,0,width=2,height=1,up=1,0,0");
  EXPECT_STREQ(light_kind_name(turned.light), "rectangle");
  EXPECT_EQ(light_kind_names(), "point, spot, sun or rectangle");
  EXPECT_TRUE(turned.has_power) << "what its target gets";
  const SceneLight again = read_light(light_text(turned)).light;
  EXPECT_NEAR(glm::distance(again.edge_u, turned.light.edge_u), 0.0, 1e-15);
  EXPECT_EQ(again.power, turned.light.power);
}

TEST(LightText, TheOldSpellingsMakeTheSameLights) {
  const auto lights_of = [](const std::vector<FieldText>& values) {
    Request request;
    assign(request, values, DOOR_LIBRARY);
    Scene scene;
    scene.bounds_min_world = glm::dvec3(-1.0);
    scene.bounds_max_world = glm::dvec3(2.0);
    return resolve_lights(scene, request, {});
  };
  const auto old = lights_of({{"light", "1,2,3,4,5,6,0.5"},
                              {"sun", "0,0,1"},
                              {"area-light", "0,3,0,0,0,0.5,2,1"},
                              {"light", "4,5,6"}});
  const auto now = lights_of({{"light", "point:at=1,2,3,power=4,5,6,radius=0.5"},
                              {"light", "sun:from=0,0,1"},
                              {"light", "rectangle:at=0,3,0,to=0,0,0.5,width=2,height=1"},
                              {"light", "point:at=4,5,6"}});
  EXPECT_EQ(old, now);
}

TEST(LightText, WhatIsMissingOrWrongIsNamed) {
  const auto expected_of = [](const char* text) -> std::string {
    try {
      static_cast<void>(read_light(text));
    } catch (const Expected& expected) {
      return expected.what;
    }
    return "";
  };
  EXPECT_EQ(expected_of("spott:at=1,2,3"),
            "a light of the kind point:, spot:, sun: or rectangle:; did you mean spot?");
  EXPECT_EQ(expected_of("spot:at=1,2,3,to=0,0,0"), "cone= of a spot");
  EXPECT_EQ(expected_of("sun:at=1,2,3"), "of a sun some of from=, power=, angle=");
  EXPECT_EQ(expected_of("point:1,2,3"), "of a point some of at=, power=, radius=, range=");
  EXPECT_EQ(expected_of("point:at=1,2"), "3 numbers in at=");
  EXPECT_EQ(expected_of("spot:at=1,2,3,to=0,0,0,cone=9,inner=9"), "inner= less than cone=");
  EXPECT_EQ(expected_of("spot:at=1,2,3,to=1,2,3,cone=9"), "a place to= other than at=");
  EXPECT_NE(expected_of("point:at=1,2,3,power=-1,0,0"), "");
  EXPECT_NE(expected_of("point:at=1,2,nan"), "");
  EXPECT_NE(expected_of("point:"), "");
}

}  // namespace
}  // namespace splatray
