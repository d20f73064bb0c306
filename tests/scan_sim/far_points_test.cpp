// Smoothing of points that are far from each other, beside others that lie close: planes are smoothed, relief stays.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "engine/scene/splat.h"
#include "tests/scan_sim/built_scan.h"

namespace splatray::testing {
namespace {

constexpr double NOISE = 0.002, CLOSE_STEP = 0.02, FAR_STEP = 0.2, FAR_BEGIN = 4.0;

/// A wall z = 0 seen from above that is close to the scanner for x < 4 and far beyond; `relief`: of waves 8 far steps long.
Points wall_with_relief(double relief) {
  Points points;
  std::mt19937_64 random(3);
  std::normal_distribution<double> noise(0.0, NOISE);
  std::uniform_real_distribution<double> jitter(-0.3, 0.3);
  const auto add = [&](double first, double last, double step, double height) {
    for (double x = first; x < last; x += step)
      for (double y = 0.0; y < 12.0; y += step) {
        const double u = x + step * jitter(random), v = y + step * jitter(random);
        points.position.emplace_back(u, v, height * std::sin(4.0 * u) * std::sin(4.0 * v) + noise(random));
      }
  };
  add(0.0, FAR_BEGIN, CLOSE_STEP, 0.0);
  add(FAR_BEGIN + FAR_STEP, 16.0, FAR_STEP, relief);
  points.stations.emplace_back().sensor_world = glm::dvec3(2.0, 6.0, 4.0);
  points.station.resize(points.size());
  return points;
}

/// The medians over the far points, away from the rims, of how far they are from z = 0 and of how far they were moved.
struct FarPoints {
  double off = 0.0, moved = 0.0;
};

double median(std::vector<double>& values) {
  if (values.empty()) return NAN;
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

FarPoints far_points(const Points& points, const BuiltScan& built) {
  std::vector<double> off, moved;
  for (std::size_t s = 0; s < built.scene.data_pool.size(); ++s) {
    const glm::dvec3 was = points.position[number_of(built.scene, s)];
    if (was.x < FAR_BEGIN + 1.0 || was.x > 15.0 || was.y < 1.0 || was.y > 11.0) continue;
    const glm::dvec3 is = built.scene.root.to_world(unpack_splat(built.scene.data_pool[s]).center);
    off.push_back(std::abs(is.z)), moved.push_back(glm::distance(is, was));
  }
  return {median(off), median(moved)};
}

TEST(FarPoints, OfPlanesAreSmoothed) {
  const Points points = wall_with_relief(0.0);
  const BuiltScan smoothed = build_scan(points, {.keep_strays = true});
  const BuiltScan rough = build_scan(points, {.smooth_world = 0.0, .keep_strays = true});
  EXPECT_GT(smoothed.stats.smoothed, 0U);
  EXPECT_LT(far_points(points, smoothed).off, 0.5 * far_points(points, rough).off);
}

TEST(FarPoints, OfReliefStay) {
  const Points points = wall_with_relief(0.1);
  const BuiltScan smoothed = build_scan(points, {.keep_strays = true});
  EXPECT_GT(smoothed.stats.smoothed, 0U);
  EXPECT_LT(far_points(points, smoothed).moved, 0.1 * NOISE);
}

}  // namespace
}  // namespace splatray::testing
