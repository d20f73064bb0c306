/// Points shown by their attributes (app/library/attributes.h).
#include "app/library/attributes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"
#include "engine/base/srgb.h"
#include "engine/scene/splat.h"
#include "preprocess/build.h"

namespace splatray {
namespace {

constexpr int EDGE = 10;

/// A sheet of points, the second half one unit higher: class 2 below and 6 above, intensity along x, two scans of which the
/// first has a place.
Scene sheet() {
  Input input;
  InputObject& object = input.objects.emplace_back();
  object.material = default_material();
  Points& points = object.points;
  std::vector<std::uint8_t> classes;
  std::vector<float> intensity;
  std::vector<std::uint16_t> scan;
  for (int x = 0; x < EDGE; ++x)
    for (int y = 0; y < EDGE; ++y) {
      const bool above = x >= EDGE / 2;
      points.position.emplace_back(x, y, above ? 1.0 : 0.0);
      classes.push_back(above ? 6 : 2);
      intensity.push_back(static_cast<float>(x));
      scan.push_back(y < EDGE / 2 ? 0 : 1);
    }
  points.columns = {{"class", classes}, {"intensity", intensity}, {"scan", scan}};
  points.stations = {{"door", glm::dvec3(0.0, 0.0, 5.0), 0, 0}, {"window", std::nullopt, 0, 0}};
  input.up = glm::dvec3(0.0, 0.0, 1.0);
  BuildStats stats;
  return build_scene(std::move(input), {}, 1, stats);
}

glm::dvec3 place(const Scene& scene, std::size_t splat) {
  return scene.root.to_world(unpack_splat(scene.data_pool[splat]).center);
}

TEST(Attributes, StayWithTheirPointsThroughTheBuild) {
  const Scene scene = sheet();
  ASSERT_EQ(scene.columns.size(), 3U);
  const Column* intensity = find_column(scene.columns, "intensity");
  const Column* classes = find_column(scene.columns, COLUMN_CLASS);
  ASSERT_EQ(intensity->size(), scene.data_pool.size());
  for (std::size_t i = 0; i < scene.data_pool.size(); ++i) {
    const glm::dvec3 p = place(scene, i);
    EXPECT_NEAR(intensity->number(i), p.x, 1e-3);
    EXPECT_EQ(classes->number(i), p.z > 0.5 ? 6.0 : 2.0);
  }
}

TEST(Attributes, ColoursFollowTheValues) {
  const Scene scene = sheet();
  const AttributeColors colors = color_by(scene, {.color_by = "intensity",
                                                  .color_range = {{0.0, EDGE - 1.0}},
                                                  .hidden_classes = {},
                                                  .hidden_scans = {}});
  ASSERT_EQ(colors.colors.size(), scene.data_pool.size());
  for (std::size_t i = 0; i < colors.colors.size(); ++i) {
    const glm::vec3 linear = unpack_color(colors.colors[i]);
    EXPECT_EQ(linear.x, linear.z) << "grey";
    const double share = std::max(std::round(place(scene, i).x), 0.0) / (EDGE - 1.0);
    EXPECT_NEAR(linear_to_srgb(linear.x), 0.25 + 0.67 * std::pow(share, 1.0 / 2.2), 0.01);
  }
  EXPECT_EQ(color_by(scene, {}).colors.size(), 0U) << "nothing is asked for";
}

TEST(Attributes, HeightAndDistanceNeedNoColumn) {
  const Scene scene = sheet();
  AttributeOptions options;
  options.color_by = "height";
  const AttributeColors height = color_by(scene, options);
  EXPECT_NEAR(height.legend.low, 0.0, 1e-3);
  EXPECT_NEAR(height.legend.high, 1.0, 1e-3);
  options.color_by = "distance";
  const AttributeColors distance = color_by(scene, options);
  EXPECT_NEAR(distance.legend.low, 4.5, 0.6) << "of the first scan's points alone";
  EXPECT_LT(distance.legend.high, 11.0);
}

TEST(Attributes, HeightIsSoftAndPlainIsNoColour) {
  Scene scene = sheet();
  AttributeOptions options;
  options.color_by = "height";
  const ColorLegend legend = color_by(scene, options).legend;
  for (const std::uint32_t color : legend.ramp) {
    const glm::vec3 linear = unpack_color(color);
    const float most = linear_to_srgb(std::max({linear.x, linear.y, linear.z}));
    EXPECT_TRUE(most > 0.3F && most < 0.85F)
        << "neither black nor white, so that shade is seen on it: " << most;
  }
  options.color_by = "plain";
  EXPECT_TRUE(color_by(scene, options).colors.empty()) << "it has none";
  scene.color_pool.edit().assign(scene.data_pool.size(), 0);
  static_cast<void>(show_attributes(scene, options));
  EXPECT_EQ(scene.color_pool,
            std::vector<std::uint32_t>(scene.data_pool.size(), pack_color(glm::vec3(1.0F))));
}

TEST(Attributes, HeightIsDarkerWhereIntensityIsLow) {
  const Scene scene = sheet();
  AttributeOptions options;
  options.color_by = "height+intensity";
  const AttributeColors both = color_by(scene, options);
  EXPECT_EQ(both.legend.title, "height");
  const Column* intensity = find_column(scene.columns, "intensity");
  float dark = 0.0F, bright = 0.0F;
  for (std::size_t i = 0; i < both.colors.size(); ++i) {
    if (intensity->number(i) == 0.0) dark = unpack_color(both.colors[i]).y;
    if (intensity->number(i) == 4.0) bright = unpack_color(both.colors[i]).y;  // of the same height
  }
  EXPECT_GT(bright, 1.5F * dark);
}

TEST(Attributes, ValuesOfBothSignsAreNeutralAtZero) {
  Scene scene = sheet();
  std::vector<float> change;
  for (std::size_t i = 0; i < scene.data_pool.size(); ++i)
    change.push_back(i == 3 ? NAN : 0.1F * static_cast<float>(i % 5) - 0.1F);  // -0.1 to 0.3
  scene.columns.push_back({"change", change});
  const AttributeColors shown = color_by(scene, {"change", {}, {}, {}});
  EXPECT_NEAR(shown.legend.high, 0.3, 1e-6);
  EXPECT_EQ(shown.legend.low, -shown.legend.high);
  const auto spread = [](std::uint32_t color) {
    const glm::vec3 rgb = unpack_color(color);
    return std::max({rgb.x, rgb.y, rgb.z}) - std::min({rgb.x, rgb.y, rgb.z});
  };
  EXPECT_LT(spread(shown.colors[1]), 0.02F) << "no change has no colour";
  EXPECT_GT(unpack_color(shown.colors[4]).x, unpack_color(shown.colors[4]).z + 0.3F) << "red before";
  EXPECT_GT(unpack_color(shown.colors[0]).z, unpack_color(shown.colors[0]).x + 0.05F) << "blue behind";
  EXPECT_LT(spread(shown.colors[3]), 0.01F);
  EXPECT_NE(shown.colors[3], shown.colors[1]) << "no number is not no change";
  const AttributeColors ranged = color_by(scene, {"change", std::array{-0.1, 0.3}, {}, {}});
  EXPECT_EQ(ranged.legend.low, -0.1);
  EXPECT_LT(spread(ranged.colors[1]), 0.02F) << "nor in a range that is not even";
  EXPECT_LT(spread(ranged.legend.ramp[64]), 0.02F);
}

TEST(Attributes, CategoriesAreCountedAndNamed) {
  const Scene scene = sheet();
  const auto classes = categories_of(scene, COLUMN_CLASS);
  ASSERT_EQ(classes.size(), 2U);
  EXPECT_EQ(classes[0].name, "ground");
  EXPECT_EQ(classes[1].value, 6U);
  EXPECT_EQ(classes[1].points, 50U);
  EXPECT_EQ(categories_of(scene, COLUMN_SCAN).at(1).name, "window");
  EXPECT_NE(classes[0].color, classes[1].color);
  EXPECT_EQ(attributes_of(scene, 0).at(0).text, "2 (ground)");
}

TEST(Attributes, KindsHaveNamesAndColours) {
  Scene scene = sheet();
  std::vector<std::uint8_t> kinds(scene.data_pool.size(), 0);
  kinds[0] = 1, kinds[1] = 2, kinds[2] = 2;
  scene.columns.push_back({std::string(COLUMN_KIND), kinds});
  AttributeOptions options;
  options.color_by = "kind";
  const AttributeColors colors = color_by(scene, options);
  ASSERT_EQ(colors.legend.categories.size(), SCAN_KINDS);
  EXPECT_EQ(colors.legend.categories[1].name, "line");
  EXPECT_EQ(colors.legend.categories[2].points, 2U);
  EXPECT_EQ(colors.colors[1], colors.colors[2]);
  EXPECT_NE(colors.colors[0], colors.colors[1]);
  EXPECT_NE(colors.colors[1], colors.colors[3]);
  EXPECT_EQ(attributes_of(scene, 0).back().text, "1 (line)");
}

TEST(Attributes, WhatIsHiddenIsTooSmallToBeSeen) {
  Scene scene = sheet();
  AttributeOptions options;
  options.hidden_classes = {6};
  options.hidden_scans = {1};
  static_cast<void>(show_attributes(scene, options));
  const Column* classes = find_column(scene.columns, COLUMN_CLASS);
  const Column* scan = find_column(scene.columns, COLUMN_SCAN);
  for (std::size_t i = 0; i < scene.data_pool.size(); ++i) {
    const bool hidden = classes->number(i) == 6.0 || scan->number(i) == 1.0;
    EXPECT_EQ(unpack_radius_squared(scene.data_pool[i]) == 2.0, hidden);
  }
}

TEST(Attributes, WhatASceneDoesNotHaveIsNamed) {
  Scene scene = sheet();
  AttributeOptions options;
  options.color_by = "return";
  try {
    static_cast<void>(color_by(scene, options));
    FAIL() << "coloured";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    EXPECT_NE(std::string(error.what())
                  .find("found 'return', expected what the scene's points have: plain, class, intensity"),
              std::string::npos)
        << error.what();
  }
  scene.columns.clear();
  options = {};
  options.hidden_classes = {2};
  EXPECT_THROW(static_cast<void>(show_attributes(scene, options)), Error);
}

TEST(Attributes, OwnColoursAreOfferedWhereThereAreSome) {
  Scene scene = sheet();
  EXPECT_EQ(color_sources(scene).front(), "plain");
  EXPECT_EQ(
      color_by(scene, {.color_by = "plain", .color_range = {}, .hidden_classes = {}, .hidden_scans = {}})
          .colors.size(),
      0U);
  scene.color_pool.edit().assign(scene.data_pool.size(), 0);
  const std::vector<std::string> sources = color_sources(scene);
  EXPECT_EQ(sources[0], "rgb");
  EXPECT_EQ(sources[1], "plain");
}

TEST(Attributes, DoNotDependOnTheOrderOfPoints) {
  // Far too few points to be smoothed. Points that differ in nothing but an attribute: which of them is which must not follow the file's order.
  const auto built = [](bool reversed) {
    Input input;
    Points& points = input.objects.emplace_back().points;
    points.position.assign(6, glm::dvec3(1.0, 2.0, 3.0));
    points.position.emplace_back(0.0, 0.0, 0.0);
    std::vector<float> values{1.0F, 5.0F, 3.0F, 2.0F, 4.0F, 6.0F, 9.0F};
    if (reversed) std::reverse(values.begin(), values.begin() + 6);
    points.columns = {{"intensity", values}};
    BuildStats stats;
    return build_scene(std::move(input), {}, 1, stats);
  };
  EXPECT_EQ(built(false).columns.at(0).values, built(true).columns.at(0).values);
}

}  // namespace
}  // namespace splatray
