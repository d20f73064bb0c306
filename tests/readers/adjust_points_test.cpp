/// What users know of points beside what their file says (preprocess/read/adjust_points.h).
#include "preprocess/read/adjust_points.h"

#include <gtest/gtest.h>

namespace splatray {
namespace {

InputObject slope() {
  InputObject object;
  object.points.position = {{0.0, 0.0, 0.0}, {1.0, 0.0, 10.0}, {0.0, 1.0, 0.0}};
  object.points.normal.assign(3, glm::vec3(-10.0F, 0.0F, 1.0F));
  return object;
}

TEST(AdjustPoints, HeightsAreScaledAndNormalsStaySquareToTheSurface) {
  InputObject object = slope();
  object.points.stations = {{"a", glm::dvec3(0.0, 0.0, 50.0), 0, 0}};
  ScanOptions options;
  options.z_scale = 0.1;
  adjust_points(object, options);
  EXPECT_EQ(object.points.position[1], glm::dvec3(1.0, 0.0, 1.0));
  const glm::dvec3 along = object.points.position[1] - object.points.position[0];
  EXPECT_NEAR(glm::dot(along, glm::dvec3(object.points.normal[0])), 0.0, 1e-6);
  EXPECT_EQ(object.points.stations[0].sensor_world->z, 5.0);
}

TEST(AdjustPoints, TheScannersPlaceIsForThoseThatDoNotSay) {
  ScanOptions options;
  options.sensor_world = glm::dvec3(1.0, 2.0, 3.0);
  InputObject without = slope(), with = slope();
  with.points.stations = {{"a", glm::dvec3(9.0), 0, 0}, {"b", {}, 0, 0}};
  adjust_points(without, options);
  adjust_points(with, options);
  ASSERT_EQ(without.points.stations.size(), 1U);
  EXPECT_EQ(without.points.stations[0].sensor_world, options.sensor_world);
  EXPECT_EQ(with.points.stations[0].sensor_world, glm::dvec3(9.0));
  EXPECT_EQ(with.points.stations[1].sensor_world, options.sensor_world);
}

TEST(AdjustPoints, NothingChangesUnasked) {
  InputObject object = slope();
  adjust_points(object, {});
  EXPECT_EQ(object.points.position, slope().points.position);
  EXPECT_TRUE(object.points.stations.empty());
}

}  // namespace
}  // namespace splatray
