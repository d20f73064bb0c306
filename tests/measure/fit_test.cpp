// Spheres and cylinders through points of known ones.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "app/library/measure/radius_fit.h"

namespace splatray {
namespace {

struct Sampled {
  std::vector<glm::dvec3> points, normals;
};

constexpr double NOISE = 0.002;
const glm::dvec3 CENTER(431250.25, 5412360.5, 217.125);

/// Points on a part of a cylinder or sphere of radius 0.3 whose normals turn by `spread` radians to each side.
Sampled sampled(bool cylinder, double spread, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> share(-1.0, 1.0);
  std::normal_distribution<double> noise(0.0, NOISE);
  const glm::dvec3 axis = glm::normalize(glm::dvec3(1.0, 2.0, 4.0));
  const glm::dvec3 u = glm::normalize(glm::cross(axis, glm::dvec3(1.0, 0.0, 0.0))), v = glm::cross(axis, u);
  Sampled made;
  for (int i = 0; i < 600; ++i) {
    const double turn = spread * share(random), rise = spread * share(random);
    const glm::dvec3 around = std::cos(turn) * u + std::sin(turn) * v;
    const glm::dvec3 n = cylinder ? around : std::cos(rise) * around + std::sin(rise) * axis;
    made.points.push_back(CENTER + (0.3 + noise(random)) * n +
                          (cylinder ? share(random) * axis : glm::dvec3(0.0)));
    made.normals.push_back(i % 2 == 0 ? n : -n);
  }
  return made;
}

void expect_radii(bool cylinder) {
  const auto fit_of = [cylinder](const Sampled& s) {
    return cylinder ? fit_cylinder(s.points, s.normals) : fit_sphere(s.points, s.normals);
  };
  int inside = 0;
  constexpr int FITS = 40;
  for (int i = 0; i < FITS; ++i) {
    const auto fit = fit_of(sampled(cylinder, 1.2, static_cast<std::uint64_t>(i)));
    ASSERT_TRUE(fit);
    EXPECT_NEAR(fit->radius, 0.3, 0.001);
    EXPECT_NEAR(fit->residual, NOISE, 0.0004);
    EXPECT_LT(fit->radius_error, 0.0005);
    inside += std::abs(fit->radius - 0.3) < 1.96 * fit->radius_error ? 1 : 0;
  }
  EXPECT_GE(inside, FITS * 85 / 100) << "intervals hold the radius";
}

TEST(RadiusFit, OfSpheresAtLargeCoordinates) { expect_radii(false); }
TEST(RadiusFit, OfCylindersAtLargeCoordinates) { expect_radii(true); }

TEST(RadiusFit, LeavesOutWhatIsNotOfTheBody) {
  Sampled sphere = sampled(false, 1.2, 3);
  for (int i = 0; i < 40; ++i) {
    sphere.points.push_back(CENTER + glm::dvec3(0.01 * i, 0.02 * i, 0.4));
    sphere.normals.emplace_back(0.0, 0.0, 1.0);
  }
  const auto fit = fit_sphere(sphere.points, sphere.normals);
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->radius, 0.3, 0.003);
}

TEST(RadiusFit, OfPlanesAndTooFewPointsIsNone) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> share(-1.0, 1.0);
  Sampled plane;
  for (int i = 0; i < 300; ++i) {
    plane.points.emplace_back(share(random), share(random), 1e-4 * share(random));
    plane.normals.emplace_back(0.0, 0.0, 1.0);
  }
  EXPECT_FALSE(fit_sphere(plane.points, plane.normals));
  EXPECT_FALSE(fit_cylinder(plane.points, plane.normals));
  plane.points.resize(7);
  plane.normals.resize(7);
  EXPECT_FALSE(fit_sphere(plane.points, plane.normals));
  EXPECT_FALSE(fit_sphere({}, {}));
}

}  // namespace
}  // namespace splatray
