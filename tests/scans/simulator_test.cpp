#include "tests/scans/simulator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace splatray::testing {
namespace {

/// Mean square of the distances of a scan's surface points from the unit sphere.
double mean_square(const SimulatedScan& scan) {
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < scan.kind.size(); ++i) {
    if (scan.kind[i] != PointKind::surface) continue;
    const double off = glm::length(scan.points.position[i]) - 1.0;
    sum += off * off, count += 1.0;
  }
  return sum / count;
}

TEST(Simulator, PointsLieOnTheSurfaceUpToTheNoise) {
  Scanner scanner = terrestrial(1.0, 0.0);
  scanner.beam_deg = scanner.stray_share = 0.0;
  const std::vector<Solid> ball{Ball{glm::dvec3(0.0), 1.0}};
  const SimulatedScan clean = simulate(ball, scanner, {glm::dvec3(0.1, 0.0, 0.0)}, 1);
  ASSERT_EQ(clean.points.size(), std::size_t{scanner.rows} * scanner.columns);
  EXPECT_LT(mean_square(clean), 1e-24);
  scanner.noise = 0.01;
  EXPECT_NEAR(std::sqrt(mean_square(simulate(ball, scanner, {glm::dvec3(0.1, 0.0, 0.0)}, 1))), 0.01, 2e-4);
}

TEST(Simulator, NormalsFaceTheScannerAndCellsAreTheGrids) {
  const glm::dvec3 sensor(0.0, 0.0, 1.5);
  const SimulatedScan scan = simulate(columned_room(), terrestrial(2.0, 0.003), {sensor}, 1);
  for (std::size_t i = 0; i < scan.kind.size(); ++i) {
    ASSERT_GT(glm::dot(sensor - scan.points.position[i], glm::dvec3(scan.normal[i])), -1e-6);
    ASSERT_LT(scan.points.grid_cell[i], scan.points.stations[0].rows * scan.points.stations[0].columns);
  }
  EXPECT_GT(std::count(scan.kind.begin(), scan.kind.end(), PointKind::mixed), 50);
  EXPECT_GT(std::count(scan.kind.begin(), scan.kind.end(), PointKind::stray), 5);
}

TEST(Simulator, TerrainIsMetWhereItsHeightSays) {
  Scanner scanner = spinning(360, 0.0);
  scanner.beam_deg = scanner.stray_share = 0.0;
  const SimulatedScan scan = simulate({Terrain{10.0}}, scanner, {glm::dvec3(0.0, 0.0, 2.0)}, 1);
  ASSERT_GT(scan.points.size(), 1000U);
  for (const glm::dvec3& p : scan.points.position)
    ASSERT_NEAR(p.z, 0.4 * std::sin(p.x) * std::cos(0.7 * p.y), 1e-9);
}

}  // namespace
}  // namespace splatray::testing
