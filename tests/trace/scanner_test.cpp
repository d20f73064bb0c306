#include "data/scanner.h"

#include <gtest/gtest.h>

#include <cmath>

#include "data/shapes.h"

namespace splatray {
namespace {

constexpr double STEP_RAD = 0.01;
const glm::dvec3 PLACE(-3.0, 0.0, 0.0);  // looks along azimuth 0, away from where angles wrap

double off_grid(double angle) { return std::abs(angle / STEP_RAD - std::floor(angle / STEP_RAD) - 0.5); }

TEST(Scanner, SeesTheNearHalfInRowsAndColumns) {
  const OrientedPoints ball = sphere({.count = 100'000}, 1.0);
  const OrientedPoints seen = scan(ball, {PLACE, STEP_RAD, 0.0});
  ASSERT_GT(seen.position.size(), 2000U);
  for (std::size_t i = 0; i < seen.position.size(); ++i) {
    const glm::dvec3 away = seen.position[i] - PLACE;
    const double cosine = -glm::dot(seen.normal[i], glm::normalize(away));
    EXPECT_GE(cosine, 0.15 - 0.02);
    const double half_cell = 0.5 * std::sqrt(2.0) * STEP_RAD * glm::length(away) / cosine;
    EXPECT_LT(std::abs(glm::length(seen.position[i]) - 1.0), half_cell * half_cell)
        << "the tangent plane within a cell";
    EXPECT_LT(seen.position[i].x, -0.3) << "the tangent cone from the place touches the ball at -1/3";
    EXPECT_LT(off_grid(std::atan2(away.y, std::hypot(away.x, away.z))), 1e-6);
    EXPECT_LT(off_grid(std::atan2(away.z, away.x)), 1e-6);
  }
}

TEST(Scanner, DoesNotSeeWhatIsBehind) {
  OrientedPoints both = sphere({.count = 100'000}, 1.0);
  append(both, moved(sphere({.count = 400'000}, 2.0), {5.0, 0.0, 0.0}));
  const OrientedPoints seen = scan(both, {PLACE, STEP_RAD, 0.0});
  for (const glm::dvec3& position : seen.position) {
    const glm::dvec3 ray = glm::normalize(position - PLACE);
    const double past = glm::length(glm::cross(ray, PLACE));
    EXPECT_TRUE(position.x < 0.0 || past > 0.97) << "a ray through the near ball ends there";
  }
}

TEST(Scanner, NoiseIsAlongTheRay) {
  const OrientedPoints ball = sphere({.count = 100'000}, 1.0);
  const OrientedPoints still = scan(ball, {PLACE, STEP_RAD, 0.0});
  const OrientedPoints noisy = scan(ball, {PLACE, STEP_RAD, 0.01});
  ASSERT_EQ(still.position.size(), noisy.position.size());
  double squares = 0.0;
  for (std::size_t i = 0; i < still.position.size(); ++i) {
    const glm::dvec3 off = noisy.position[i] - still.position[i];
    EXPECT_LT(glm::length(glm::cross(off, glm::normalize(still.position[i] - PLACE))), 1e-12);
    squares += glm::dot(off, off);
  }
  EXPECT_NEAR(std::sqrt(squares / static_cast<double>(still.position.size())), 0.01, 5e-4);
}

}  // namespace
}  // namespace splatray
