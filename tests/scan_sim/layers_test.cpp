// Walls, layers of one surface and sparse surveys: what smoothing may join, and what not.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "engine/scene/splat.h"
#include "tests/scan_sim/built_scan.h"

namespace splatray::testing {
namespace {

/// A wall of this thickness, both its sides, points 25 mm apart with noise of 2 mm across; upright or, for its side views, with the
/// places that it was seen from.
Points wall(double thickness, bool stations, bool with_back = true) {
  Points points;
  std::mt19937_64 random(9);
  std::normal_distribution<double> noise(0.0, 0.002);
  std::uniform_real_distribution<double> along(0.0, 1.0);
  for (const double side : {0.0, 1.0}) {
    if (side > 0.0 && !with_back) break;
    for (int i = 0; i < 4800; ++i) {
      points.position.emplace_back(2.0 * along(random), side * thickness + noise(random),
                                   1.5 * along(random));
      if (stations) points.station.push_back(static_cast<std::uint16_t>(side));
    }
  }
  if (stations)
    for (const double y : {-3.0, 3.0 + thickness}) {
      Station station;
      station.sensor_world = glm::dvec3(1.0, y, 0.75);
      points.stations.push_back(station);
    }
  return points;
}

/// Medians of where the splats of the front (y < half the thickness) and the back lie, and the share that faces away from the
/// other.
struct WallSides {
  double front, back, apart;
};
WallSides sides_of_wall(const Scene& scene, double thickness) {
  std::vector<double> front, back;
  double apart = 0.0;
  for (const uvec4& words : scene.data_pool) {
    const double y = scene.root.to_world(unpack_center(words)).y;
    const bool behind = y > 0.5 * thickness;
    (behind ? back : front).push_back(y);
    apart += (unpack_splat(words).normal.y > 0.0F) == behind ? 1.0 : 0.0;
  }
  const auto middle = [](std::vector<double>& values) {
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                     values.end());
    return values.empty() ? NAN : values[values.size() / 2];
  };
  return {middle(front), middle(back), apart / static_cast<double>(scene.data_pool.size())};
}

TEST(ScanLayers, BothSidesOfAWallStayWhereTheyAre) {
  for (const bool stations : {true, false})
    for (const double thickness : {0.02, 0.03, 0.05, 0.1, 0.2}) {
      SCOPED_TRACE(std::to_string(thickness) + (stations ? " with stations" : ""));
      const BuiltScan built = build_scan(wall(thickness, stations));
      const WallSides sides = sides_of_wall(built.scene, thickness);
      EXPECT_NEAR(sides.front, 0.0, 0.0005);
      EXPECT_NEAR(sides.back, thickness, 0.0005);
      if (stations || thickness < 0.1) {
        EXPECT_GT(sides.apart, 0.97);
      }
    }
}

/// Two scans of one side of a wall, one set off by their noise: one surface.
TEST(ScanLayers, LayersThatFaceTheSameWayBecomeOne) {
  Points points = wall(0.004, true);
  points.stations[1].sensor_world = glm::dvec3(0.5, -3.0, 0.75);
  const BuiltScan built = build_scan(points), off = build_scan(points, {.smooth_world = 0.0});
  const auto deviation = [](const Scene& scene) {
    double sum = 0.0, squares = 0.0;
    for (const uvec4& words : scene.data_pool) {
      const double y = scene.root.to_world(unpack_center(words)).y;
      sum += y, squares += y * y;
    }
    const auto count = static_cast<double>(scene.data_pool.size());
    return std::sqrt(squares / count - sum / count * (sum / count));
  };
  EXPECT_LT(deviation(built.scene), 0.35 * deviation(off.scene));
}

/// A survey of mountains and trees, 200 m from point to point: each height is one measured place, none is another's noise.
TEST(ScanLayers, HeightsOfASparseSurveyStay) {
  Points points;
  std::mt19937_64 random(13);
  std::uniform_real_distribution<double> along(0.0, 20000.0), tree(2.0, 25.0);
  for (int i = 0; i < 10000; ++i) {
    const double x = along(random), y = along(random);
    double height = 0.0;
    for (double wave = 16000.0; wave > 200.0; wave *= 0.5)
      height += 0.02 * wave * std::sin(x / wave * 6.0 + wave) * std::cos(y / wave * 5.0 - wave);
    points.position.emplace_back(x, y, height + (i % 3 == 0 ? tree(random) : 0.0));
  }
  const std::vector<glm::dvec3> measured = points.position;
  const BuiltScan built = build_scan(points);
  const Column& number = *find_column(built.scene.columns, POINT_NUMBER);
  for (std::size_t s = 0; s < built.scene.data_pool.size(); ++s) {
    const glm::dvec3 place = built.scene.root.to_world(unpack_center(built.scene.data_pool[s]));
    ASSERT_LT(glm::distance(place, measured[static_cast<std::size_t>(number.number(s))]), 0.1);
  }
}

}  // namespace
}  // namespace splatray::testing
