/// Estimated normals: exact on planes, close on curved surfaces, defined where points do not make a plane.
#include "preprocess/surface/normals.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "tests/preprocess/shapes.h"

namespace splatray {
namespace {

constexpr glm::dvec3 UP(0.0, 1.0, 0.0);

void estimate(Cloud& cloud) { estimate_normals(cloud, UP, {"normals", test::SILENT}); }

TEST(Normals, PlaneIsExactAndAllOnOneSide) {
  InputObject object = test::square_lattice(20, 0.5);
  object.points.normal.clear();
  for (glm::dvec3& p : object.points.position) p = {p.x, p.y, 0.5 * p.x};
  Cloud cloud = test::cloud_of(object);
  estimate(cloud);
  const glm::dvec3 expected = glm::normalize(glm::dvec3(-0.5, 0.0, 1.0));
  for (const glm::vec3& normal : cloud.normal) {
    EXPECT_NEAR(std::abs(glm::dot(glm::dvec3(normal), expected)), 1.0, 1e-6);
    EXPECT_GT(glm::dot(normal, cloud.normal[0]), 0.0F);
  }
}

TEST(Normals, SpherePointsOutwardsWithinTwoDegrees) {
  InputObject object = test::even_sphere(5000, {3.0, -2.0, 1.0});
  object.points.normal.clear();
  Cloud cloud = test::cloud_of(object);
  estimate(cloud);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const glm::dvec3 outward = cloud.position[i] - glm::dvec3(3.0, -2.0, 1.0);
    EXPECT_GT(glm::dot(glm::dvec3(cloud.normal[i]), outward), std::cos(glm::radians(2.0)));
  }
}

TEST(Normals, OnlyUnusableOnesAreEstimated) {
  InputObject object = test::square_lattice(10, 1.0);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  object.points.normal.assign(100, glm::vec3(0.0F, 3.0F, 0.0F));
  object.points.normal[3] = glm::vec3(0.0F);
  object.points.normal[50] = glm::vec3(nan, 0.0F, 1.0F);
  object.points.normal[60] = glm::vec3(0.0F, 0.0F, 1e-30F);
  BuildStats stats;
  Cloud cloud = make_cloud(std::move(object.points), false, false, stats);
  EXPECT_EQ(stats.normals_given, 98U);
  EXPECT_EQ(estimate_normals(cloud, UP, {"normals", test::SILENT}), 2U);
  int along_z = 0;
  for (const glm::vec3& normal : cloud.normal) {
    EXPECT_NEAR(glm::length(normal), 1.0F, 1e-6F);
    along_z += std::abs(normal.z) > 0.999F ? 1 : 0;
  }
  EXPECT_EQ(along_z, 3);
}

TEST(Normals, DegenerateNeighbourhoodsHaveTheStatedNormals) {
  const std::array<glm::dvec3, 1> point{glm::dvec3(0.0)};
  EXPECT_EQ(plane_normal(point, UP), UP);
  const std::array<glm::dvec3, 3> line{glm::dvec3(0.0), glm::dvec3(1.0, 1.0, 0.0), glm::dvec3(2.0, 2.0, 0.0)};
  EXPECT_LT(glm::length(plane_normal(line, UP) - glm::normalize(glm::dvec3(-1.0, 1.0, 0.0))), 1e-9);
  const std::array<glm::dvec3, 2> upright{glm::dvec3(0.0), UP};
  const glm::dvec3 normal = plane_normal(upright, UP);
  EXPECT_NEAR(glm::length(normal), 1.0, 1e-12);
  EXPECT_NEAR(glm::dot(normal, UP), 0.0, 1e-9);
}

}  // namespace
}  // namespace splatray
