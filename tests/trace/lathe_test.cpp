// Surfaces of revolution of the generator, against the sphere and the cone.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "data/shapes.h"

namespace splatray::testing {
namespace {

constexpr double PI = std::numbers::pi;

/// From the lower pole to the upper one.
glm::dvec2 half_circle(double parameter) { return {std::sin(PI * parameter), -std::cos(PI * parameter)}; }

TEST(Lathe, OfAHalfCircleIsAnEvenSphere) {
  constexpr std::uint64_t COUNT = 20000;
  EXPECT_NEAR(lathe_area(half_circle), 4.0 * PI, 1e-5);
  const OrientedPoints points = lathe({.count = COUNT}, half_circle);
  ASSERT_EQ(points.position.size(), COUNT);
  std::size_t below = 0;
  for (std::size_t i = 0; i < COUNT; ++i) {
    EXPECT_NEAR(glm::length(points.position[i]), 1.0, 1e-6);
    EXPECT_NEAR(glm::dot(points.position[i], points.normal[i]), 1.0, 1e-4);
    below += points.position[i].y < -0.5 ? 1 : 0;
  }
  EXPECT_NEAR(double(below) / COUNT, 0.25, 1e-3);  // Archimedes: area goes by height
}

TEST(Lathe, OfAFallingProfileFacesTheAxis) {
  const OrientedPoints points = lathe({.count = 100}, spline({{1.0, 1.0}, {1.0, 0.0}}));
  for (std::size_t i = 0; i < 100; ++i)
    EXPECT_NEAR(glm::dot(points.normal[i], points.position[i] - glm::dvec3(0.0, points.position[i].y, 0.0)),
                -1.0, 1e-9);
}

TEST(Lathe, ASplineMeetsItsPointsAndHasNoNegativeRadius) {
  const Profile profile = spline({{0.0, 0.0}, {2.0, 0.0}, {0.0, 1.0}, {0.0, 2.0}});
  EXPECT_LT(glm::distance(profile(1.0 / 3.0), glm::dvec2(2.0, 0.0)), 1e-12);
  EXPECT_LT(glm::distance(profile(2.0 / 3.0), glm::dvec2(0.0, 1.0)), 1e-12);
  for (double parameter = 0.0; parameter <= 1.0; parameter += 0.01) EXPECT_GE(profile(parameter).x, 0.0);
}

}  // namespace
}  // namespace splatray::testing
