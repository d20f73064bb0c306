/// Points that are written and read again (preprocess/write).
#include "preprocess/write/write_points.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <random>

#include "engine/base/error.h"
#include "engine/scene/clip.h"
#include "engine/scene/scene_splat.h"
#include "engine/scene/splat.h"
#include "preprocess/write/left_out.h"
#include "tests/preprocess/shapes.h"
#include "tests/temp_folder.h"

namespace splatray {
namespace {

/// The points of a scanned corner of a room with a ceiling, far from the origin, without normals; with `strays` above it.
Input corner_scan(int strays = 0) {
  Input input;
  InputObject& object = input.objects.emplace_back();
  object.name = "scans";
  object.material = default_material();
  Points& points = object.points;
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> place(0.0, 4.0);
  std::vector<double> time;
  std::vector<std::uint8_t> classes;
  const glm::dvec3 corner(600000.0, 5000000.0, 300.0);
  for (int i = 0; i < 8000 + strays; ++i) {
    glm::dvec3 p(place(random), place(random), place(random));
    if (i < 8000) p[i % 3] = i % 4 == 3 && i % 3 == 2 ? 4.0 : 0.0;
    if (i >= 8000) p += glm::dvec3(0.0, 0.0, 8.0 + 4.0 * (i - 8000));
    points.position.push_back(corner + p);
    points.color.emplace_back(std::abs(std::sin(p.x)), 0.001 * p.y, 0.1 * p.z);
    points.station.push_back(static_cast<std::uint16_t>(i % 2));
    classes.push_back(static_cast<std::uint8_t>(1 + i % 3));
    time.push_back(1e9 + 1e-6 * i);
  }
  points.stations = {{"door side", corner + glm::dvec3(2.0, 1.5, 1.75)},
                     {"window", corner + glm::dvec3(1.5, 2.0, 1.75)}};
  points.columns = {{std::string(COLUMN_CLASS), std::move(classes)},
                    {std::string(COLUMN_TIME), std::move(time)},
                    {std::string(COLUMN_SCAN), points.station},
                    {"my own, number", std::vector<float>(points.size(), 0.1F)}};
  input.up = glm::dvec3(0.0, 0.0, 1.0);
  input.crs = "PROJCS[\"UTM\",\n  UNIT[\"metre\",1]]";
  return input;
}

Scene built(Input input) {
  BuildStats stats;
  return build_scene(std::move(input), {}, 1, stats);
}

/// The file that the scene's points are written to.
std::filesystem::path written(const Scene& scene, const TempFolder& folder, const std::string& name,
                              const LeftOut& left_out = {}) {
  const std::filesystem::path path = folder.path() / name;
  write_points(make_point_table(scene, left_out), path, {});
  return path;
}

Scene read_again(const Scene& scene, const std::string& name = "points.ply") {
  const TempFolder folder;
  return built(read_input({written(scene, folder, name)}, {}));
}

void expect_same_pools(const Scene& a, const Scene& b) {
  EXPECT_EQ(a.root.origin_world, b.root.origin_world);
  EXPECT_EQ(a.root.unit_world, b.root.unit_world);
  EXPECT_TRUE(a.node_pool == b.node_pool);
  EXPECT_TRUE(a.begin_end == b.begin_end);
  EXPECT_TRUE(a.slab_pool == b.slab_pool);
  EXPECT_TRUE(a.reference_pool == b.reference_pool);
  EXPECT_TRUE(a.data_pool == b.data_pool);
  EXPECT_TRUE(a.color_pool == b.color_pool);
  EXPECT_TRUE(a.field_pool == b.field_pool);
  EXPECT_TRUE(a.clip_pool == b.clip_pool);
}

class WriteAgain : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Formats, WriteAgain, ::testing::Values("points.ply", "points.vtp"));

TEST_P(WriteAgain, AScanIsTheSameBits) {
  const Scene scene = built(corner_scan());
  ASSERT_FALSE(scene.clip_pool.empty()) << "the corner has creases";
  const Scene again = read_again(scene, GetParam());
  expect_same_pools(scene, again);
  EXPECT_EQ(again.up, scene.up);
  EXPECT_EQ(again.crs, "PROJCS[\"UTM\",   UNIT[\"metre\",1]]") << "in one line";
  ASSERT_EQ(again.stations.size(), 2U);
  for (std::size_t s = 0; s < 2; ++s) {
    EXPECT_EQ(again.stations[s].name, scene.stations[s].name);
    EXPECT_EQ(again.stations[s].sensor_world, scene.stations[s].sensor_world);
    EXPECT_GT(scene.stations[s].step_world, 0.0);
    EXPECT_EQ(again.stations[s].step_world, scene.stations[s].step_world);
    EXPECT_EQ(again.stations[s].noise_world, scene.stations[s].noise_world);
  }
  for (const Column& column : scene.columns) {
    const Column* same =
        find_column(again.columns, column.name == "my own, number" ? "my_own__number" : column.name);
    ASSERT_NE(same, nullptr) << column.name;
    for (std::size_t i = 0; i < column.size(); ++i)
      ASSERT_EQ(same->number(i), column.number(i)) << column.name;
  }
}

TEST_P(WriteAgain, UpSystemAndScansAreKeptBesideWhatWasLeftOut) {
  Scene scene = built(corner_scan());
  scene.up = glm::dvec3(1.0, 0.0, 0.0);
  LeftOut left_out;
  left_out.position = {glm::dvec3(600000.0, 5000000.0, 350.0)};
  const TempFolder folder;
  const Input input = read_input({written(scene, folder, GetParam(), left_out)}, {});
  EXPECT_EQ(input.up, std::optional(scene.up));
  EXPECT_EQ(input.crs, "PROJCS[\"UTM\",   UNIT[\"metre\",1]]");
  const Points& points = input.objects.at(0).points;
  EXPECT_FALSE(points.lattice) << "not all of them are splats";
  ASSERT_EQ(points.stations.size(), 2U);
  EXPECT_EQ(points.stations[1].name, "window");
  EXPECT_EQ(points.stations[1].step_world, scene.stations[1].step_world);
}

TEST(WritePly, AnyWordsOfFieldsClipsAndEllipsesAreKept) {
  Scene scene = built(test::input_of(test::even_sphere(3000)));
  ASSERT_FALSE(scene.field_pool.empty());
  scene.clip_pool.edit().assign(scene.data_pool.size(), CLIP_NONE);
  scene.clip_pool.edit()[7] = pack_ellipse(scene.data_pool[7], {1.0, 0.0, 0.0}, 3.0);
  scene.field_pool.edit()[9] = pack_lean({0.25, 0.0, 0.0}, unpack_splat(scene.data_pool[9]).normal);
  const Scene again = read_again(scene);
  EXPECT_TRUE(again.data_pool == scene.data_pool);
  EXPECT_TRUE(again.clip_pool == scene.clip_pool);
  EXPECT_TRUE(again.field_pool == scene.field_pool);
  expect_same_pools(again, read_again(again));
}

TEST(WritePly, UnknownChangesStayUnknown) {
  Scene scene = built(test::input_of(test::even_sphere(100)));
  std::vector<float> change(scene.data_pool.size(), 0.25F);
  change[3] = NAN;
  scene.columns.push_back({std::string(COLUMN_CHANGE), change});
  const Column column = *find_column(read_again(scene).columns, COLUMN_CHANGE);
  for (std::size_t i = 0; i < column.size(); ++i) {
    if (i == 3)
      EXPECT_TRUE(std::isnan(column.number(i)));
    else
      ASSERT_EQ(column.number(i), 0.25);
  }
}

/// Directions on the borders of the octahedron's square have two codes, of which packing must choose one.
TEST(WritePly, NormalsOfDownwardFacesAreTheSameBits) {
  InputObject object = test::square_lattice(12, 0.1);
  for (std::size_t i = 0; i < object.points.size(); ++i) {
    const double turn = 0.1 * static_cast<double>(i);
    object.points.normal[i] = i % 3 == 0   ? glm::vec3(-1e-12F, -1e-12F, -1.0F)
                              : i % 3 == 1 ? glm::vec3(std::sin(turn), -1e-9F, -std::abs(std::cos(turn)))
                                           : glm::vec3(-1e-9F, std::sin(turn), -std::abs(std::cos(turn)));
  }
  const Scene scene = built(test::input_of(object));
  expect_same_pools(scene, read_again(scene));
}

TEST(WritePly, WhatWasMovedIsNoSplatAnyMore) {
  const Scene scene = built(test::input_of(test::even_sphere(2000)));
  const TempFolder folder;
  Input input = read_input({written(scene, folder, "a.ply")}, {});
  input.objects[0].points.position[5].x += 0.4 * scene.root.unit_world;
  const Scene moved = built(std::move(input));
  EXPECT_NE(moved.root.unit_world, scene.root.unit_world);
  EXPECT_EQ(moved.data_pool.size(), scene.data_pool.size());
  BuildParams larger;
  larger.radius_scale = 2.0;
  BuildStats stats;
  const Scene scaled = build_scene(read_input({folder.path() / "a.ply"}, {}), larger, 1, stats);
  EXPECT_NEAR(stats.radius_median_world / std::sqrt(unpack_radius_squared(scene.data_pool[0])) /
                  scene.root.unit_world,
              2.0, 0.2);
}

TEST(WritePly, ForgedRemarksAreHarmless) {
  const Scene scene = built(test::input_of(test::even_sphere(300)));
  const TempFolder folder;
  std::ifstream file(written(scene, folder, "a.ply"), std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  const std::size_t begin = bytes.find("splatray lattice "), end = bytes.find('\n', begin);
  for (const char* lattice :
       {"0 0 0 1e-300", "0 0 0 1e300", "-1 -1 -1 1e-6", "0 0 0 0", "nan 0 0 1", "1 2 3"}) {
    std::string forged = bytes;
    forged.replace(begin, end - begin, std::string("splatray lattice ") + lattice);
    EXPECT_EQ(built(read_input({folder.write("b.ply", forged)}, {})).data_pool.size(), 300U) << lattice;
  }
}

/// Where splats are, world units, in the scene's order.
std::vector<glm::dvec3> places(const Scene& scene) {
  std::vector<glm::dvec3> list;
  for (const uvec4& words : scene.data_pool) list.push_back(scene.root.to_world(unpack_center(words)));
  return list;
}

TEST(WriteLas, OurReaderFindsAllOfIt) {
  const Scene scene = built(corner_scan());
  const TempFolder folder;
  ReadOptions options;
  options.scans.attributes = {"NormalX", "NormalZ", "radius", "my_own__number"};
  const Input input = read_input({written(scene, folder, "a.las")}, options);
  const Points& points = input.objects.at(0).points;
  EXPECT_TRUE(points.position == places(scene)) << "to the last bit";
  EXPECT_EQ(input.crs, scene.crs);
  for (std::size_t i = 0; i < points.size(); i += 7) {
    const Splat splat = unpack_splat(scene.data_pool[i]);
    ASSERT_EQ(find_column(points.columns, "NormalX")->number(i), static_cast<float>(splat.normal.x));
    ASSERT_EQ(find_column(points.columns, "NormalZ")->number(i), static_cast<float>(splat.normal.z));
    ASSERT_EQ(points.normal.at(i), glm::vec3(splat.normal));
    ASSERT_EQ(points.radius.at(i), find_column(points.columns, "radius")->number(i));
    ASSERT_EQ(find_column(points.columns, "my_own__number")->number(i), 0.1F);
    ASSERT_EQ(pack_color(points.color[i]), scene.color_pool[i]);
    for (const std::string_view name : {COLUMN_CLASS, COLUMN_TIME})
      ASSERT_EQ(find_column(points.columns, name)->number(i), find_column(scene.columns, name)->number(i));
  }
}

TEST(WriteLas, SystemsAreTextOrKeys) {
  Scene scene = built(test::input_of(test::even_sphere(100)));
  const TempFolder folder;
  for (const std::string& crs :
       {std::string("EPSG:2264+5703;xy=0.3048006096012192;z=1"), std::string("EPSG:4326;deg"),
        "PROJCS[\"long " + std::string(70000, 'g') + "\"]"}) {
    scene.crs = crs;
    EXPECT_EQ(read_input({written(scene, folder, "a.las")}, {}).crs, crs);
  }
}

TEST(WriteVtp, VtkFindsAllOfIt) {
  Scene scene = built(corner_scan());
  scene.color_pool.edit().assign(scene.data_pool.size(), pack_color({1.0F, 0.0F, 0.5F}));
  const TempFolder folder;
  const Input input = read_input({written(scene, folder, "a.vtp")}, {});
  const Points& points = input.objects.at(0).points;
  EXPECT_TRUE(points.position == places(scene)) << "to the last bit";
  ASSERT_EQ(points.normal.size(), scene.data_pool.size());
  for (std::size_t i = 0; i < points.size(); i += 7) {
    const Splat splat = unpack_splat(scene.data_pool[i]);
    ASSERT_EQ(points.normal[i], glm::vec3(splat.normal));
    ASSERT_NEAR(points.radius[i], std::sqrt(splat.radius_squared) * scene.root.unit_world,
                2e-4 * points.radius[i]);
    ASSERT_EQ(pack_color(points.color[i]), scene.color_pool[i]);
    ASSERT_EQ(find_column(points.columns, COLUMN_TIME)->number(i),
              find_column(scene.columns, COLUMN_TIME)->number(i));
  }
}

TEST(WriteCsv, NumbersReadAsTheSameBits) {
  const Scene scene = built(corner_scan());
  const TempFolder folder;
  const Input input = read_input({written(scene, folder, "a.csv")}, {});
  const Points& points = input.objects.at(0).points;
  EXPECT_TRUE(points.position == places(scene));
  EXPECT_EQ(find_column(points.columns, COLUMN_TIME)->number(3),
            find_column(scene.columns, COLUMN_TIME)->number(3));
  ASSERT_EQ(points.radius.size(), points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    EXPECT_NEAR(points.radius[i], splat_at(scene, i).radius_world(), 2e-4 * points.radius[i]) << i;
}

TEST(LeftOutPoints, AreWrittenAsLowNoise) {
  constexpr int STRAYS = 5;
  Input input = corner_scan(STRAYS);
  const std::vector<glm::dvec3> all = input.objects[0].points.position;
  LeftOutPoints numbered(input);
  Scene scene = built(std::move(input));
  const LeftOut left_out = std::move(numbered).take(scene);
  EXPECT_EQ(find_column(scene.columns, "number of the input's point"), nullptr);
  ASSERT_GE(left_out.position.size(), std::size_t{STRAYS});
  for (int i = 0; i < STRAYS; ++i)
    EXPECT_EQ(std::count(left_out.position.begin(), left_out.position.end(),
                         all[8000 + static_cast<std::size_t>(i)]),
              1);
  expect_same_pools(scene, built(corner_scan(STRAYS)));
  const TempFolder folder;
  for (const char* name : {"a.las", "a.ply"}) {
    ReadOptions options;
    options.scans.keep_withheld = true;
    const Points points = read_input({written(scene, folder, name, left_out)}, options).objects.at(0).points;
    ASSERT_EQ(points.size(), scene.data_pool.size() + left_out.position.size());
    const Column* classes = find_column(points.columns, COLUMN_CLASS);
    ASSERT_NE(classes, nullptr);
    for (std::size_t i = 0; i < points.size(); ++i)
      ASSERT_EQ(classes->number(i) == 7.0, i >= scene.data_pool.size()) << name;
    EXPECT_LT(glm::length(points.position.back() - left_out.position.back()), 2.0 * scene.root.unit_world);
  }
}

TEST(WritePoints, WhatLasCannotHoldIsRefused) {
  const Scene scene = built(test::input_of(test::even_sphere(100)));
  LeftOut far;
  far.position = {glm::dvec3(1e12, 0.0, 0.0)};
  const TempFolder folder;
  try {
    static_cast<void>(written(scene, folder, "a.las", far));
    ADD_FAILURE() << "it was written";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::failed);
    EXPECT_NE(std::string(error.what()).find("which LAS cannot hold"), std::string::npos) << error.what();
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  EXPECT_EQ(read_input({written(scene, folder, "a.ply", far)}, {}).objects.at(0).points.size(), 101U);
}

TEST(WritePoints, WhatAFormatHasNoPlaceForIsNamed) {
  Scene scene = built(corner_scan());
  for (const char* name : {"a.ply", "a.vtp"}) EXPECT_EQ(lost_by_format(scene, name), "") << name;
  EXPECT_EQ(lost_by_format(scene, "a.las"),
            "a.las: its format does not hold the places of scanners; .ply and .vtp do");
  scene.up = glm::dvec3(0.0, 1.0, 0.0);
  EXPECT_EQ(lost_by_format(scene, "a.csv"),
            "a.csv: its format does not hold the up direction 0,1,0 (it is read with 0,0,1), the coordinate "
            "system, the places of scanners; .ply and .vtp do");
}

TEST(WritePoints, CanBeStopped) {
  const Scene scene = built(test::input_of(test::even_sphere(100)));
  const TempFolder folder;
  for (const char* name : {"a.ply", "a.las", "a.csv", "a.vtp"}) {
    EXPECT_THROW(write_points(make_point_table(scene, {}), folder.path() / name,
                              [](const char* /*stage*/, double /*share*/) { return false; }),
                 Error);
    EXPECT_TRUE(std::filesystem::is_empty(folder.path())) << name;
  }
}

}  // namespace
}  // namespace splatray
