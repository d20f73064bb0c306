#include "preprocess/base/point_arrays.h"

#include <gtest/gtest.h>

namespace splatray {
namespace {

/// Points with all arrays.
Points full_points(std::size_t size) {
  Points points;
  std::apply([&](const auto&... arrays) { ((points.*arrays.values).resize(size), ...); }, POINT_ARRAYS);
  points.columns = {{"intensity", std::vector<std::uint16_t>(size, 7)}};
  return points;
}

void expect_size(Points points, std::size_t size) {
  std::size_t arrays = 0;
  for_each_array(points, [&](const auto& values) { EXPECT_EQ(values.size(), size) << ++arrays; });
}

Points bare_points(std::size_t size) {
  Points points;
  points.position.resize(size);
  return points;
}

TEST(PointArrays, OfOneSideAreFilledOnTheOther) {
  Points full_first = full_points(2), bare_first = bare_points(3);
  append_points(full_first, bare_points(3));
  expect_size(full_first, 5);
  append_points(bare_first, full_points(2));
  expect_size(bare_first, 5);
  EXPECT_EQ(full_first.grid_cell[4], NO_CELL);
  EXPECT_EQ(full_first.clip_words[4], CLIP_NONE);
  EXPECT_EQ(full_first.color[4], glm::vec3(1.0F));
  EXPECT_EQ(bare_first.field_words[0], FIELD_FLAT);
  EXPECT_EQ(bare_first.columns[0].number(2), 0.0);
  EXPECT_EQ(bare_first.columns[0].number(3), 7.0);
}

TEST(PointArrays, OfNeitherSideStayEmpty) {
  Points points = bare_points(1);
  append_points(points, bare_points(2));
  EXPECT_EQ(points.size(), 3U);
  EXPECT_TRUE(points.normal.empty() && points.color.empty() && points.station.empty());
}

/// An export of splats (splat_field, splat_clip) as one of two point sets of an object.
TEST(PointArrays, OfSplatsGoOnBesideOtherPointSets) {
  Input input;
  InputObject& object = input.objects.emplace_back();
  object.meshes.resize(2);
  object.meshes[0].vertices = full_points(2);
  object.meshes[1].vertices = bare_points(3);
  finish_objects(input, {});
  ASSERT_EQ(input.objects[0].points.size(), 5U);
  expect_size(input.objects[0].points, 5);
}

}  // namespace
}  // namespace splatray
