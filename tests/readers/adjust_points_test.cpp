/// What users know of points beside what their file says (preprocess/read/adjust_points.h).
#include "preprocess/read/adjust_points.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/readers/read_error.h"

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

TEST(AdjustPoints, EllipsesAreStretchedWithTheHeights) {
  const float half = std::sqrt(0.5F);
  InputObject object;
  object.points.position.assign(2, glm::dvec3(0.0));
  object.points.normal.assign(2, glm::vec3(1.0F, 0.0F, 0.0F));
  object.points.radius = {2.0F, 2.0F};
  object.points.ellipse = {{{0.0F, 0.0F, 1.0F}, 2.0F, 2.0F}, {{0.0F, half, half}, 2.0F, 2.0F}};
  ScanOptions options;
  options.z_scale = 4.0;
  adjust_points(object, options);
  const std::vector<PointEllipse>& ellipse = object.points.ellipse;
  EXPECT_NEAR(object.points.radius[0], 4.0F, 1e-5) << "what was across is along now";
  EXPECT_NEAR(ellipse[0].aspect, 2.0F, 1e-5);
  EXPECT_NEAR(std::abs(ellipse[0].short_axis.y), 1.0F, 1e-5);
  // y^2 and z^2 of the tilted one: by its support along each axis, sqrt(sum of the squares of its half axes there).
  const float most_z = 4.0F * std::sqrt(0.5F * (4.0F + 1.0F)), most_y = std::sqrt(0.5F * (4.0F + 1.0F));
  const glm::vec3 narrow = ellipse[1].short_axis, wide = glm::cross(glm::vec3(1.0F, 0.0F, 0.0F), narrow);
  const float length = ellipse[1].half_length, width = length / ellipse[1].aspect;
  EXPECT_NEAR(std::hypot(length * wide.z, width * narrow.z), most_z, 1e-4);
  EXPECT_NEAR(std::hypot(length * wide.y, width * narrow.y), most_y, 1e-4);
  EXPECT_NEAR(length * width, 2.0F * 1.0F * 4.0F, 1e-4) << "the area grows by the factor";
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

TEST(Trajectory, IsReadByHeaderOrInOrderAndGivenToPointsOfItsTimes) {
  const TempFolder folder;
  const auto points = folder.write("p.csv", "x,y,z,gps_time\n0,0,0,10\n1,0,0,11\n0,1,0,12\n");
  ReadOptions options;
  const std::string bare = "12 5 6 900\n10 1 2 900\n";
  for (const auto& [name, text] :
       {std::pair("bare.txt", bare), {"named.csv", std::string("X,Y,Z,Time\n1,2,900,10\n5,6,900,12\n")}}) {
    options.scans.trajectory = folder.write(name, text);
    const Points read = read_input({points}, options).objects.at(0).points;
    ASSERT_EQ(read.track.size(), 2U) << name;
    EXPECT_EQ(read.track[0].time, 10.0) << name;
    EXPECT_EQ(read.track[1].sensor_world, glm::dvec3(5.0, 6.0, 900.0)) << name;
  }
  options.scans.z_scale = 0.5;
  EXPECT_EQ(read_input({points}, options).objects.at(0).points.track[0].sensor_world.z, 450.0);
}

TEST(Trajectory, ThatSaysNothingIsRefused) {
  const TempFolder folder;
  const auto points = folder.write("p.csv", "x,y,z,gps_time\n0,0,0,10\n1,0,0,11\n0,1,0,12\n");
  const auto refusal = [&](const std::filesystem::path& track) {
    ReadOptions options;
    options.scans.trajectory = track;
    try {
      static_cast<void>(read_input({points}, options));
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::input_unreadable);
      EXPECT_NE(std::string(error.what()).find(track.string()), std::string::npos) << error.what();
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(refusal(folder.write("later.txt", "13 0 0 9\n14 0 0 9\n")).find("no point that has a time"),
            std::string::npos);
  EXPECT_NE(refusal(folder.write("once.txt", "10 0 0 9\n10 0 0 9\n")).find("one time alone"),
            std::string::npos);
  EXPECT_NE(refusal(folder.path() / "none.txt"), "");
}

TEST(AdjustPoints, NothingChangesUnasked) {
  InputObject object = slope();
  adjust_points(object, {});
  EXPECT_EQ(object.points.position, slope().points.position);
  EXPECT_TRUE(object.points.stations.empty());
}

}  // namespace
}  // namespace splatray
