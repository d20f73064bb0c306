// Spheres and cylinders through points of known ones.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>

#include "app/library/measure/measure.h"
#include "app/library/measure/surface_point.h"
#include "tests/scan_sim/built_scan.h"

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

/// Smoothing moves bent surfaces inwards, by more than what the noise of so many points leaves of a radius.
TEST(RadiusFit, OfSmoothedPointsHoldsTheTruthInTheInterval) {
  constexpr double RADIUS = 0.3;
  for (const bool cylinder : {false, true})
    for (const unsigned seed : {1U, 2U}) {
      std::mt19937 random(seed);
      std::normal_distribution<double> normal;
      Points points;
      for (int i = 0; i < 30000; ++i) {
        const glm::dvec3 any(normal(random), normal(random), cylinder ? 0.0 : normal(random));
        const double along = cylinder ? std::uniform_real_distribution<double>(-0.5, 0.5)(random) : 0.0;
        points.position.push_back((RADIUS + NOISE * normal(random)) * glm::normalize(any) +
                                  glm::dvec3(0.0, 0.0, along));
      }
      const testing::BuiltScan built = testing::build_scan(points);
      ASSERT_GT(built.stats.moved_median_world, 0.3 * NOISE) << "nothing moved, nothing shown";
      const MeasureKind kind = cylinder ? MeasureKind::cylinder : MeasureKind::sphere;
      Measure measure{kind, {{{RADIUS, 0.0, 0.0}}}};
      measure.fit = radius_near(built.scene, {}, {RADIUS, 0.0, 0.0}, 0.4, kind);
      ASSERT_TRUE(measure.fit);
      const MeasureValue radius = values_of(measure, {0.0, 0.0, 1.0}).front();
      EXPECT_NEAR(radius.value, RADIUS, radius.within) << cylinder << ' ' << seed;
      EXPECT_LT(radius.within, 0.5 * NOISE) << cylinder << ' ' << seed;
      std::printf("%s %u: off by %.3g, interval %.3g\n", measure_name(kind), seed, radius.value - RADIUS,
                  radius.within);
    }
}

/// Points of a floor of 2 x 0.5 that leans by `tilt_deg` across its short side, where its direction is least sure.
std::vector<glm::dvec3> leaning_floor(double tilt_deg, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> share(-1.0, 1.0);
  std::normal_distribution<double> noise(0.0, NOISE);
  const double turn = glm::radians(tilt_deg);
  const glm::dvec3 across(0.0, std::cos(turn), std::sin(turn)), normal(0.0, -std::sin(turn), std::cos(turn));
  std::vector<glm::dvec3> points;
  for (int i = 0; i < 300; ++i)
    points.push_back(CENTER + glm::dvec3(share(random), 0.0, 0.0) + 0.25 * share(random) * across +
                     noise(random) * normal);
  return points;
}

double tilt_of(const Measure& measure, double& within) {
  const MeasureValue value = values_of(measure, {0.0, 0.0, 1.0}).front();
  within = value.within;
  return value.value;
}

TEST(PlaneFit, OfAFloorHoldsItsTiltInTheInterval) {
  constexpr int FITS = 400;
  int inside = 0;
  for (int i = 0; i < FITS; ++i) {
    Measure measure{MeasureKind::plane, {{CENTER}}};
    measure.plane = fit_plane(leaning_floor(2.0, static_cast<std::uint64_t>(i)));
    ASSERT_TRUE(measure.plane);
    EXPECT_NEAR(measure.plane->residual, NOISE, 0.0004);
    double within = 0.0;
    inside += std::abs(tilt_of(measure, within) - 2.0) < within ? 1 : 0;
    EXPECT_LT(within, 0.2);
  }
  std::printf("%d of %d inside\n", inside, FITS);
  EXPECT_GE(inside, FITS * 92 / 100);
  EXPECT_LE(inside, FITS * 98 / 100) << "intervals are no wider than they must";
}

TEST(PlaneFit, LeavesOutWhatStandsOnIt) {
  std::vector<glm::dvec3> points = leaning_floor(0.0, 1);
  for (int i = 0; i < 15; ++i) points.push_back(CENTER + glm::dvec3(0.9, 0.2, 0.05 + 0.01 * i));
  const auto fit = fit_plane(points);
  ASSERT_TRUE(fit);
  EXPECT_LT(fit->residual, 2.0 * NOISE);
  EXPECT_GT(std::abs(fit->normal.z), 0.99999);
}

TEST(PlaneFit, OfALineAndTooFewPointsIsNone) {
  std::vector<glm::dvec3> points;
  for (int i = 0; i < 50; ++i) points.push_back(CENTER + 0.1 * i * glm::dvec3(1.0, 2.0, 3.0));
  EXPECT_FALSE(fit_plane(points));
  EXPECT_FALSE(fit_plane(std::vector(20, CENTER)));
  EXPECT_FALSE(fit_plane({}));
}

}  // namespace
}  // namespace splatray
