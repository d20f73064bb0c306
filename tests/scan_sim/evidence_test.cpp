// Large discs of scans: those that are seen to be of a surface stay, clutter far off becomes dots, closed scans stay bit for bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "engine/scene/splat.h"
#include "preprocess/scan/evidence.h"
#include "tests/scan_sim/built_scan.h"

namespace splatray::testing {
namespace {

constexpr double FLOOR_STEP = 0.02, WALL_STEP = 0.2;

/// A floor of 2 x 2 m, points 2 cm apart; `wall`: beside it one of 8 x 8 m, points 20 cm apart; `clutter`: so many points in a cube of
/// 8 m beside that, on no surface.
Points floor_with(bool wall, std::size_t clutter) {
  Points points;
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> jitter(-0.3, 0.3), unit(0.0, 1.0);
  const auto add = [&](glm::dvec3 corner, double side, double step) {
    for (double u = 0.0; u < side; u += step)
      for (double v = 0.0; v < side; v += step)
        points.position.push_back(corner +
                                  glm::dvec3(u + step * jitter(random), v + step * jitter(random), 0.0));
  };
  add({0, 0, 0}, 2.0, FLOOR_STEP);
  if (wall) add({3, 0, 0}, 8.0, WALL_STEP);
  for (std::size_t i = 0; i < clutter; ++i)
    points.position.push_back(glm::dvec3(12, 0, 0) +
                              8.0 * glm::dvec3(unit(random), unit(random), unit(random)));
  return points;
}

/// Radii, world units, of the drawn points with x between two values.
std::vector<double> radii_between(const Scene& scene, double low, double high) {
  std::vector<double> radii;
  for (const uvec4& words : scene.data_pool) {
    const Splat splat = unpack_splat(words);
    const double x = scene.root.to_world(splat.center).x;
    if (x >= low && x <= high) radii.push_back(std::sqrt(splat.radius_squared) * scene.root.unit_world);
  }
  std::sort(radii.begin(), radii.end());
  return radii;
}

TEST(Evidence, ClutterBecomesDots) {
  const BuiltScan built = build_scan(floor_with(true, 400), {.keep_strays = true});
  EXPECT_GT(built.stats.dots, 200U);
  const std::vector<double> dots = radii_between(built.scene, 12.0, 20.0);
  ASSERT_GT(dots.size(), 300U);
  EXPECT_LT(dots[dots.size() * 9 / 10], 3.0 * FLOOR_STEP) << "of points some 0.8 m apart";
}

TEST(Evidence, SparseWallsStayClosed) {
  const std::vector<double> before = radii_between(build_scan(floor_with(true, 0)).scene, 4.0, 10.0),
                            after = radii_between(build_scan(floor_with(true, 400)).scene, 4.0, 10.0);
  ASSERT_EQ(before.size(), after.size());
  ASSERT_GT(before.size(), 800U);
  EXPECT_GT(before.front(), 0.5 * WALL_STEP);
  for (std::size_t i = 0; i < before.size(); ++i) EXPECT_GT(after[i], 0.9 * before[i]);
}

TEST(Evidence, ClosedScansStayAsTheyAre) {
  EXPECT_EQ(build_scan(floor_with(true, 0)).stats.dots, 0U);
  EXPECT_EQ(build_scan(floor_with(true, 6)).stats.dots, 0U) << "a little clutter does not make a scan sparse";
}

TEST(Evidence, GivenRadiiStay) {
  Points points = floor_with(true, 400);
  points.radius.assign(points.size(), 0.05F);
  std::fill(points.radius.end() - 400, points.radius.end(), 1.0F);
  points.normal.assign(points.size(), glm::vec3(0, 0, 1));
  const BuiltScan built = build_scan(points, {.keep_strays = true});
  EXPECT_EQ(built.stats.dots, 0U);
  const std::vector<double> plates = radii_between(built.scene, 12.0, 20.0);
  ASSERT_FALSE(plates.empty());
  EXPECT_NEAR(plates.front(), 1.0, 0.01);
}

}  // namespace
}  // namespace splatray::testing
