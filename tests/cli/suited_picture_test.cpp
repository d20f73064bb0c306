/// What is chosen for pictures of scans of which nothing is said.

#include <gtest/gtest.h>

#include "app/library/picture/scene_source.h"
#include "tests/host/scenes.h"

namespace splatray {
namespace {

/// A flat site of 50 x 50 points, on a slope along x.
Scene site() {
  OrientedPoints points;
  for (int x = 0; x < 50; ++x)
    for (int y = 0; y < 50; ++y) points.emplace_back(glm::dvec3(x, y, 0.1 * x), glm::dvec3(0.0, 0.0, 1.0));
  return scan_scene(points);
}

Scene room() { return scan_scene(box_points({4.0, 5.0, 3.0}, true)); }

Request suited(const Scene& scene, const Request& request = {}) {
  return suited_picture(scene, request).request;
}

/// A grey for each splat, from `dark` to `bright`.
void colour(Scene& scene, float dark, float bright) {
  scene.color_pool.clear();
  for (std::size_t i = 0; i < scene.data_pool.size(); ++i) {
    const float share = static_cast<float>(i) / static_cast<float>(scene.data_pool.size());
    scene.color_pool.push_back(pack_color(glm::vec3(dark + share * (bright - dark))));
  }
}

TEST(SuitedPicture, OfAModelIsAsAskedFor) {
  Scene model = site();
  model.stations.clear();
  const SuitedPicture picture = suited_picture(model, {});
  EXPECT_EQ(picture.request, Request{});
  EXPECT_EQ(picture.choices, "");
}

TEST(SuitedPicture, WithoutColoursShowsTheShapeInLight) {
  const SuitedPicture land = suited_picture(site(), {});
  EXPECT_EQ(land.choices, "a site: --view oblique --color-by height --look lit");
  EXPECT_EQ(land.request.view.viewpoint, Viewpoint::oblique);
  EXPECT_EQ(land.request.look.attributes.color_by, "height");
  EXPECT_EQ(land.request.look.style, LOOK_LIT);
  EXPECT_FALSE(land.request.settings.cutaway);
}

TEST(SuitedPicture, RoomsLieOpenUnlessAScannerStandsInThem) {
  Scene scene = room();
  EXPECT_EQ(suited_picture(scene, {}).choices, "a room: --view dollhouse --color-by height --look lit");
  EXPECT_TRUE(suited(scene).settings.cutaway);
  scene.stations[0].sensor_world = glm::dvec3(0.0);
  const SuitedPicture inside = suited_picture(scene, {});
  EXPECT_EQ(inside.choices, "a room: --view inside --color-by height --look scan")
      << "light comes from outside, which a closed room has none of";
  EXPECT_FALSE(inside.request.settings.cutaway);
}

TEST(SuitedPicture, ColoursThatSaySomethingComeFirst) {
  Scene scene = site();
  std::vector<float> intensity(scene.data_pool.size());
  for (std::size_t i = 0; i < intensity.size(); ++i) intensity[i] = static_cast<float>(i % 200);
  scene.columns = {{std::string(COLUMN_INTENSITY), intensity}};
  EXPECT_EQ(suited(scene).look.attributes.color_by, "height+intensity");
  EXPECT_EQ(suited(scene).look.style, LOOK_LIT);
  colour(scene, 0.5F, 0.5F);
  EXPECT_EQ(suited(scene).look.attributes.color_by, "height+intensity") << "all colours are one";
  colour(scene, 0.1F, 0.8F);
  EXPECT_EQ(suited(scene).look.attributes.color_by, "rgb");
  EXPECT_EQ(suited(scene).look.style, LOOK_SCAN);
  colour(scene, 0.0F, 0.0F);
  intensity.assign(intensity.size(), 7.0F);
  intensity.back() = 9.0F;
  scene.columns = {{std::string(COLUMN_INTENSITY), intensity}};
  EXPECT_EQ(suited(scene).look.attributes.color_by, "height") << "nor does one value say anything";
}

TEST(SuitedPicture, WhatIsAskedForStays) {
  Request asked;
  asked.view.viewpoint = Viewpoint::top;
  asked.look.attributes.color_by = "normal";
  asked.look.style = LOOK_CLAY;
  const SuitedPicture picture = suited_picture(room(), asked);
  EXPECT_EQ(picture.request, asked);
  EXPECT_EQ(picture.choices, "");
  asked.look.style.reset();
  asked.look.environment = "white";
  EXPECT_FALSE(suited(room(), asked).look.style) << "an environment asks for its light";
}

TEST(SuitedPicture, ADollhouseMayBeSeenFromAnEyeOfOnesOwn) {
  Request asked;
  asked.view.viewpoint = Viewpoint::dollhouse;
  asked.view.eye = glm::dvec3(0.0, 0.0, 9.0);
  EXPECT_TRUE(suited(room(), asked).settings.cutaway);
  EXPECT_EQ(choose_camera(room(), suited(room(), asked)).eye, *asked.view.eye);
  asked.view.viewpoint = Viewpoint::automatic;
  EXPECT_FALSE(suited(room(), asked).settings.cutaway);
}

TEST(SuitedPicture, ChoosingTwiceChangesNothing) {
  for (const Scene& scene : {site(), room()}) EXPECT_EQ(suited(scene, suited(scene)), suited(scene));
}

}  // namespace
}  // namespace splatray
