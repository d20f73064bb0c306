/// What is said of a picture's light and of options that it does not use; the light of a camera that is shut in.
#include "app/library/shot/picture_notes.h"
#include "app/library/shot/resolve.h"

#include <gtest/gtest.h>

#include <fstream>

#include "app/library/picture/make_picture.h"
#include "app/library/request/fields.h"
#include "app/library/shot/scene_source.h"
#include "engine/device/host/host_device.h"

namespace splatray {
namespace {

Request asked(const std::vector<FieldText>& values) {
  Request request;
  assign(request, values, DOOR_RENDER);
  return request;
}

TEST(PictureNotes, OptionsThatALookDoesNotUse) {
  const auto count = [](const std::vector<FieldText>& values, std::uint32_t look) {
    return ignored_options(asked(values), look).size();
  };
  const std::vector<FieldText> light = {{"light", "1,2,3"}}, material = {{"material", "gold"}},
                               reach = {{"ao-radius", "1"}}, straight = {{"glass-shadows", "straight"}},
                               lens = {{"aperture", "1"}, {"focus", "2"}}, bounces = {{"bounces", "3"}};
  for (const std::uint32_t look : {LOOK_PAPER, LOOK_LIT, LOOK_CLAY, LOOK_AO, LOOK_SCAN}) {
    EXPECT_EQ(count({}, look), 0U);
    EXPECT_EQ(count(light, look), look == LOOK_AO ? 1U : 0U);
    EXPECT_EQ(count(material, look), look == LOOK_PAPER || look == LOOK_LIT ? 0U : 1U);
    EXPECT_EQ(count(reach, look), look == LOOK_AO || look == LOOK_SCAN ? 0U : 1U);
    EXPECT_EQ(count(straight, look), look == LOOK_LIT ? 0U : 1U);
    EXPECT_EQ(count(lens, look), look == LOOK_PAPER ? 2U : 0U);
    EXPECT_EQ(count(bounces, look), look == LOOK_AO || look == LOOK_SCAN ? 1U : 0U);
  }
  EXPECT_EQ(count({{"focus", "2"}}, LOOK_LIT), 1U) << "without an aperture";
  EXPECT_EQ(count({{"object", "0:hidden=on"}}, LOOK_AO), 0U) << "no material";
  EXPECT_EQ(ignored_options(asked({{"clamp", "10"}, {"sun", "0,0,1"}}), LOOK_AO),
            (std::vector<std::string>{"this --look does not use --sun, --look lit, clay, scan and paper do",
                                      "this --look does not use --clamp, --look lit and clay do"}));
}

TEST(PictureNotes, LightThatIsNotThere) {
  Look look;
  Settings settings;
  settings.look = LOOK_LIT;
  const auto show = [&look](const Environment& environment) {
    look.environment = std::make_shared<const Environment>(environment);
  };
  show({2, 1, {vec3(0.0F), vec3(0.0F)}, vec3(1.0F)});
  EXPECT_EQ(missing_light(look, settings).size(), 1U) << "a picture that is black";
  look.lights = {{LIGHT_POINT, {}, vec3(0.0F)}};
  EXPECT_EQ(missing_light(look, settings).size(), 2U) << "and a light without power";
  look.lights.push_back({LIGHT_POINT, {}, vec3(1.0F)});
  EXPECT_EQ(missing_light(look, settings), std::vector<std::string>{"1 of 2 lights have no power"});
  look.lights = {};
  look.materials = {Material{}};
  look.materials[0].emission = vec3(0.0F, 1.0F, 0.0F);
  EXPECT_TRUE(missing_light(look, settings).empty()) << "an object sends out light";
  look.materials = {};
  show({0, 0, {}, vec3(1.0F)});
  EXPECT_TRUE(missing_light(look, settings).empty());
  settings.environment_strength = 0.0F;
  EXPECT_EQ(missing_light(look, settings).size(), 1U);
  settings.look = LOOK_AO;
  EXPECT_TRUE(missing_light(look, settings).empty());
}

/// The corners 0 to 1 of a box, its faces inwards, as OBJ.
std::string room_obj(bool open) {
  return std::string(
             "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\nv 1 1 1\n"
             "f 1 2 4 3\nf 1 5 6 2\nf 3 4 8 7\nf 1 3 7 5\nf 2 6 8 4\n") +
         (open ? "" : "f 5 7 8 6\n");
}

TEST(EyeLight, ComesToCamerasThatAreShutIn) {
  const HostDevice device;
  for (const bool open : {false, true}) {
    const std::string path = ::testing::TempDir() + "room.obj";
    std::ofstream(path) << room_obj(open);
    Request request = asked({{"inputs", path},
                             {"mesh-points", "6000"},
                             {"eye", "0.5,0.5,0.9"},
                             {"target", "0.5,0.5,0"},
                             {"look", "lit"},
                             {"resolution", "8x8"},
                             {"samples", "4"}});
    LoadedScene loaded = load_scene(request, {});
    SceneOnDevice shown(device);
    shown.open(loaded.scene);
    shown.show_environment("studio");
    const auto made = [&] {
      const Shot shot = resolve(request, loaded.scene, loaded.facts);
      return make_picture(shot, shown, shot.view.camera, {});
    };
    const MadePicture first = made();
    double mean = 0.0;
    for (const vec4& pixel : first.image.rgba) mean += double(pixel.x) / double(first.image.rgba.size());
    EXPECT_GT(mean, open ? 0.05 : 0.4);
    EXPECT_LT(mean, 2.0);
    EXPECT_EQ(first.notes.size(), open ? 0U : 1U);
    assign(request, {{"sun", "0,0,1"}}, DOOR_RENDER);
    EXPECT_TRUE(made().notes.empty()) << "lights that are asked for are taken as they are";
  }
}

}  // namespace
}  // namespace splatray
