/// Means of points: what they say of those that they are of, and how many there are.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "preprocess/levels/level_means.h"
#include "preprocess/read/tiles/tile_schema.h"

namespace splatray {
namespace {

TEST(MeansOfPoints, AreOfLightAndOfTheMostFrequentClass) {
  TileSchema schema;
  using Kind = TileField::Kind;
  for (const char* name : TILE_PLACE) schema.add({.name = name, .kind = Kind::floating, .bytes = 8});
  for (const char* name : TILE_COLOUR) schema.add({.name = name, .bytes = 2});
  for (const char* name : TILE_NORMAL) schema.add({.name = name, .kind = Kind::floating, .bytes = 4});
  schema.add({.name = TILE_CLASS, .bytes = 1});
  schema.add({.name = "ReturnNumber", .bytes = 1});
  // Three of a cell, one of it that is noise, one of another cell.
  const double values[5][11] = {{0.1, 0.2, 0.1, 0, 65535, 100, 0, 0, 1, 6, 1},
                                {0.2, 0.2, 0.1, 65535, 65535, 100, 0, 0, 1, 2, 2},
                                {0.3, 0.2, 0.4, 0, 65535, 100, 0, 0, -1, 2, 3},
                                {0.3, 0.2, 0.4, 0, 0, 0, 0, 0, 1, 7, 4},
                                {0.7, 0.2, 0.1, 5, 6, 7, 1, 0, 0, 9, 5}};
  std::vector<unsigned char> records(5 * schema.record_bytes);
  for (std::size_t i = 0; i < 5; ++i)
    for (std::size_t f = 0; f < 11; ++f)
      schema.fields[f].store(values[i][f], records.data() + i * schema.record_bytes);
  const auto means_of = [&](const std::vector<unsigned char>& of, const TileSchema& with) {
    std::vector<unsigned char> means;
    append_means(of, with, LevelLattice{glm::dvec3(0.0), 1.0}, 1, means);
    return means;
  };
  const std::vector<unsigned char> means = means_of(records, schema);
  const TileSchema with_counts = tile_means_schema(schema);
  ASSERT_EQ(means.size(), 3 * with_counts.record_bytes);
  const auto value = [&](std::size_t mean, const char* name) {
    return with_counts.find(name)->value(means.data() + mean * with_counts.record_bytes);
  };
  EXPECT_NEAR(value(0, "X"), 0.2, 1e-12);
  EXPECT_NEAR(value(0, "Z"), 0.2, 1e-12);
  EXPECT_NEAR(value(0, "Red"), 65535.0 * std::pow(1.0 / 3.0, 1.0 / 2.2), 1.0);
  EXPECT_EQ(value(0, "Green"), 65535.0);
  EXPECT_EQ(value(0, "NormalZ"), 0.0) << "sides that cancel have no normal";
  EXPECT_EQ(value(0, TILE_CLASS), 2.0);
  EXPECT_EQ(value(0, "ReturnNumber"), 2.0);
  EXPECT_EQ(value(0, COLUMN_POINT_COUNT), 3.0);
  EXPECT_EQ(value(1, TILE_CLASS), 7.0);
  EXPECT_EQ(value(2, "NormalX"), 1.0);
  EXPECT_EQ(value(2, COLUMN_POINT_COUNT), 1.0);
  EXPECT_EQ(means_of(means, with_counts), means) << "means of single means are these";
}

/// How many means there are of 32 points in each of `cells`^2 cells of a floor, which is `colour_of` its places, and of what `also` adds.
std::size_t means_of_floor(int cells, const std::function<double(const glm::dvec3&)>& colour_of,
                           const std::vector<glm::dvec3>& also = {}) {
  TileSchema schema;
  for (const char* name : TILE_PLACE)
    schema.add({.name = name, .kind = TileField::Kind::floating, .bytes = 8});
  for (const char* name : TILE_COLOUR) schema.add({.name = name, .bytes = 2});
  std::mt19937 random(3);
  std::uniform_real_distribution<double> within(0.0, 1.0 / 64.0);
  std::vector<glm::dvec3> places = also;
  for (int i = 0; i < 32 * cells * cells; ++i)
    places.emplace_back(glm::dvec3(i % cells, i / cells % cells, 0) / 64.0 +
                        glm::dvec3(within(random), within(random), 0.003 + 0.01 * within(random)));
  std::vector<unsigned char> records(places.size() * schema.record_bytes), means;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double colour = colour_of(places[i]);
    const double values[6] = {places[i].x, places[i].y, places[i].z, colour, colour, colour};
    for (std::size_t f = 0; f < 6; ++f)
      schema.fields[f].store(values[f], records.data() + i * schema.record_bytes);
  }
  append_means(records, schema, LevelLattice{glm::dvec3(0.0), 1.0}, 6, means);
  return means.size() / tile_means_schema(schema).record_bytes;
}

TEST(MeansOfPoints, AreOfEighthsWhereSurfacesMeetOrChangeTheirColour) {
  const auto grey = [](const glm::dvec3&) { return 20000.0; };
  EXPECT_EQ(means_of_floor(8, grey), 64U);
  // Half of the cells at x = 4 / 64 are dark.
  const double middle = 4.5 / 64.0;
  EXPECT_EQ(means_of_floor(8, [&](const glm::dvec3& at) { return at.x < middle ? 20000.0 : 5000.0; }),
            64U + 8U * 3U);
  // A wall of four cells' height in the middle of these: the lowest ones hold some of the floor.
  std::mt19937 random(4);
  std::uniform_real_distribution<double> within(0.0, 1.0);
  std::vector<glm::dvec3> wall, leaves;
  for (int i = 0; i < 4096; ++i)
    wall.emplace_back(middle - 0.001, within(random) / 8.0, 0.0001 + within(random) / 17.0);
  EXPECT_EQ(means_of_floor(8, grey, wall), 64U + 24U + 8U * 5U);
  // A cube full of leaves, away from the floor: each of its cells is one mean, whatever its colours are.
  for (int i = 0; i < 16384; ++i)
    leaves.emplace_back(0.5 + within(random) / 16.0, 0.5 + within(random) / 16.0,
                        0.5 + within(random) / 16.0);
  const auto motley = [&](const glm::dvec3& at) {
    return at.z > 0.25 && std::fmod(1e5 * at.z, 1.0) > 0.5 ? 5000.0 : 20000.0;
  };
  EXPECT_EQ(means_of_floor(8, motley, leaves), 64U + 64U);
}

}  // namespace
}  // namespace splatray
