/// Normal fields: exact where the surface is known, none where it is flat, little where normals are noise.
#include "preprocess/surface/normal_field.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <random>

#include "preprocess/surface/radius.h"
#include "tests/preprocess/shapes.h"

namespace splatray {
namespace {

Cloud fitted(InputObject object) {
  Cloud cloud = test::cloud_of(std::move(object));
  find_radii(cloud, RadiusRule::coverage, 1.0, true, {"radii", test::SILENT});
  return cloud;
}

Scene scene_of(InputObject object, bool normal_fields = true) {
  BuildParams params;
  params.normal_fields = normal_fields;
  BuildStats stats;
  return build_scene(test::input_of(std::move(object)), params, 0, stats);
}

/// The plane z = 0 with every normal leaning by about `lean` at random.
InputObject noisy_lattice(double lean) {
  InputObject object = test::square_lattice(30, 1.0);
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal(0.0, lean);
  for (glm::vec3& n : object.points.normal)
    n = glm::vec3(glm::normalize(glm::dvec3(normal(random), normal(random), 1.0)));
  return object;
}

/// Mean length of the fields, per radius.
double mean_slope(const Cloud& cloud) {
  double sum = 0.0;
  for (std::size_t i = 0; i < cloud.size(); ++i)
    sum += glm::length(glm::dvec3(cloud.field[i])) * static_cast<double>(cloud.radius[i]);
  return sum / static_cast<double>(cloud.size());
}

TEST(NormalField, OfASphereIsItsCurvature) {
  for (InputObject object : {test::even_sphere(5000, {3.0, -2.0, 1.0}), test::random_sphere(5000, 2)}) {
    const Cloud cloud = fitted(std::move(object));
    const auto curvature = static_cast<float>(cloud.half_extent_world);  // of the unit sphere
    for (const glm::vec3& field : cloud.field) {
      EXPECT_NEAR(field.x, curvature, 0.03F);
      EXPECT_NEAR(field.y, 0.0F, 0.03F);
      EXPECT_NEAR(field.z, curvature, 0.03F);
    }
  }
}

TEST(NormalField, OfACylinderBendsOneWay) {
  InputObject object = test::square_lattice(60, 0.05);
  for (std::size_t i = 0; i < object.points.size(); ++i) {
    glm::dvec3& p = object.points.position[i];
    object.points.normal[i] = glm::vec3(std::sin(p.x), 0.0, std::cos(p.x));
    p = {std::sin(p.x), p.y, std::cos(p.x)};
  }
  const Cloud cloud = fitted(std::move(object));
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const glm::vec3& field = cloud.field[i];
    const double unit = 1.0 / cloud.half_extent_world;
    const double trace = unit * static_cast<double>(field.x + field.z);
    const double determinant = unit * unit * static_cast<double>(field.x * field.z - field.y * field.y);
    EXPECT_NEAR(trace, 1.0, 0.02);
    EXPECT_NEAR(determinant, 0.0, 0.02);
  }
}

TEST(NormalField, NormalsThatMayBeTurnedAreTurnedAlike) {
  InputObject object = test::even_sphere(5000);
  object.oriented = false;
  for (std::size_t i = 0; i < object.points.size(); i += 3) object.points.normal[i] *= -1.0F;
  const Cloud cloud = fitted(std::move(object));
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const bool outwards = glm::dot(glm::dvec3(cloud.normal[i]), cloud.position[i]) > 0.0;
    EXPECT_NEAR(cloud.field[i].x, outwards ? 1.0F : -1.0F, 0.03F);
  }
}

TEST(NormalField, NoiseLeavesDiscsNearlyFlat) {
  EXPECT_LT(mean_slope(fitted(noisy_lattice(0.05))), 0.015) << "a plain fit follows the noise: about 0.03";
}

TEST(NormalField, OnlyCurvedScenesHaveThem) {
  EXPECT_TRUE(scene_of(test::square_lattice(20, 0.5)).field_pool.empty());
  const Scene sphere = scene_of(test::even_sphere(1000));
  EXPECT_EQ(sphere.field_pool.size(), sphere.data_pool.size());
  EXPECT_TRUE(scene_of(test::even_sphere(1000), false).field_pool.empty());
}

}  // namespace
}  // namespace splatray
