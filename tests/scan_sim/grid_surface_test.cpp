// What preprocess makes of depth cameras' grids: the camera, the surface, what is left out.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numbers>
#include <numeric>
#include <random>

#include "engine/scene/splat.h"
#include "tests/all_tests.h"
#include "tests/scan_sim/built_scan.h"
#include "tests/scan_sim/scan_cases.h"
#include "tests/scan_sim/sim_meshes.h"

namespace splatray::testing {
namespace {

double at_share(std::vector<double> values, double share) {
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size()));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

bool is_on_ball(const glm::dvec3& place) {
  return std::abs(glm::distance(place, CORNER_BALL) - CORNER_BALL_RADIUS) < 0.002;
}

/// How far splats are from what they truly are, of planes or of the ball.
struct Errors {
  std::vector<double> angles_deg;
  std::vector<double> depths;  ///< along the line of sight, in units of the range
};

Errors errors_of(const SimulatedScan& scan, const Scene& scene, bool ball) {
  const glm::dvec3 sensor = *scan.points.stations[0].sensor_world;
  Errors errors;
  for (std::size_t s = 0; s < scene.data_pool.size(); ++s) {
    const std::size_t i = number_of(scene, s);
    if (scan.kind[i] != PointKind::surface || is_on_ball(scan.position[i]) != ball) continue;
    const Splat splat = unpack_splat(scene.data_pool[s]);
    const double cosine = std::clamp(glm::dot(splat.normal, scan.normal[i]), -1.0, 1.0);
    errors.angles_deg.push_back(std::acos(cosine) * 180.0 / std::numbers::pi);
    const double range = glm::distance(scan.position[i], sensor);
    errors.depths.push_back(std::abs(glm::distance(scene.root.to_world(splat.center), sensor) / range - 1.0));
  }
  return errors;
}

/// Shares of the points of a kind that are drawn.
double drawn_share(const SimulatedScan& scan, const Scene& scene, PointKind kind) {
  double all = 0.0, drawn = 0.0;
  for (const PointKind is : scan.kind) all += is == kind ? 1.0 : 0.0;
  for (std::size_t s = 0; s < scene.data_pool.size(); ++s)
    drawn += scan.kind[number_of(scene, s)] == kind ? 1.0 : 0.0;
  return drawn / std::max(all, 1.0);
}

TEST(GridSurface, StepsOfDepthBecomeTheSurface) {
  const SimulatedScan scan = corner_by_depth_camera();
  const BuiltScan built = build_scan(scan.points);
  const Errors walls = errors_of(scan, built.scene, false), ball = errors_of(scan, built.scene, true);
  ASSERT_GT(walls.angles_deg.size(), 40000U);
  ASSERT_GT(ball.angles_deg.size(), 2000U);
  EXPECT_LT(at_share(walls.angles_deg, 0.5), 0.6);
  EXPECT_LT(at_share(walls.angles_deg, 0.95), 4.0);
  EXPECT_LT(at_share(ball.angles_deg, 0.5), 2.0);
  EXPECT_LT(at_share(walls.depths, 0.5), 0.0004);
  EXPECT_LT(at_share(walls.depths, 0.95), 0.0015);
  EXPECT_LT(at_share(ball.depths, 0.5), 0.0004);
  for (std::size_t s = 0; s < built.scene.data_pool.size(); ++s)
    ASSERT_LT(glm::dot(unpack_splat(built.scene.data_pool[s]).normal,
                       built.scene.root.to_world(unpack_splat(built.scene.data_pool[s]).center) -
                           *scan.points.stations[0].sensor_world),
              0.0);
}

TEST(GridSurface, LayersOfEqualDepthAreNoStrays) {
  const SimulatedScan scan = corner_by_depth_camera();
  const BuiltScan built = build_scan(scan.points);
  EXPECT_GT(drawn_share(scan, built.scene, PointKind::surface), 0.999);
  EXPECT_LT(drawn_share(scan, built.scene, PointKind::stray), 0.05);
  EXPECT_LT(drawn_share(scan, built.scene, PointKind::mixed), 0.4);
  EXPECT_EQ(built.stats.dropped_isolated, 0U);
  EXPECT_EQ(built.stats.dropped_mixed, scan.size() - built.scene.data_pool.size());
}

/// Few of a sparse grid's cells are filled: what supports its points is little, but usual.
TEST(GridSurface, SparseGridsKeepTheirPoints) {
  SimulatedScan scan = corner_by_depth_camera();
  Points sparse;
  sparse.stations = scan.points.stations;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const std::uint32_t cell = scan.points.grid_cell[i];
    if (cell % 320 % 3 != 0 || cell / 320 % 3 != 0) continue;
    sparse.position.push_back(scan.points.position[i]);
    sparse.grid_cell.push_back(cell);
  }
  const BuiltScan built = build_scan(sparse);
  EXPECT_GT(built.stats.smoothed, 0U);
  EXPECT_GT(built.scene.data_pool.size(), sparse.size() * 97 / 100);
}

/// The wall behind has one depth: what lies before it determines the unit.
TEST(GridSurface, OneStepOfDepthBehindShowsNothing) {
  SimulatedScan scan = corner_by_depth_camera({.columns = 160, .rows = 120, .focal = 145.0});
  const glm::dvec3 sensor = *scan.points.stations[0].sensor_world;
  const glm::dvec3 ahead = glm::normalize(glm::dvec3(0.9, 1.0, 0.6) - sensor);
  for (glm::dvec3& position : scan.points.position) {
    const double depth = glm::dot(position - sensor, ahead);
    if (depth > 2.4) position = sensor + (position - sensor) * (4.0 / depth);
  }
  const BuiltScan built = build_scan(scan.points);
  EXPECT_GT(built.stats.smoothed, 0U);
  for (const uvec4& words : built.scene.data_pool)
    ASSERT_TRUE(std::isfinite(glm::length(unpack_splat(words).normal)));
}

TEST(GridSurface, PointsMoveAlongTheirLinesOfSight) {
  const SimulatedScan scan = corner_by_depth_camera();
  const glm::dvec3 sensor = *scan.points.stations[0].sensor_world;
  const BuiltScan built = build_scan(scan.points);
  EXPECT_EQ(built.stats.smoothed, built.scene.data_pool.size());
  for (std::size_t s = 0; s < built.scene.data_pool.size(); ++s) {
    const glm::dvec3 is = built.scene.root.to_world(unpack_splat(built.scene.data_pool[s]).center) - sensor;
    const glm::dvec3 was = scan.points.position[number_of(built.scene, s)] - sensor;
    ASSERT_LT(glm::length(glm::cross(is, glm::normalize(was))), 1e-5);
  }
}

TEST(GridSurface, NothingMovesWhereSmoothingIsOff) {
  const SimulatedScan scan = corner_by_depth_camera();
  const BuiltScan built = build_scan(scan.points, {.smooth_world = 0.0});
  EXPECT_EQ(built.stats.smoothed, 0U);
  for (std::size_t s = 0; s < built.scene.data_pool.size(); ++s)
    ASSERT_LT(glm::distance(built.scene.root.to_world(unpack_splat(built.scene.data_pool[s]).center),
                            scan.points.position[number_of(built.scene, s)]),
              1e-5);
  EXPECT_LT(at_share(errors_of(scan, built.scene, false).angles_deg, 0.5), 1.0);
}

TEST(GridSurface, GivenNormalsStay) {
  const SimulatedScan scan = corner_by_depth_camera();
  Points points = scan.points;
  const glm::dvec3 leaning = glm::normalize(glm::dvec3(0.3, 0.2, 0.9));
  points.normal.assign(points.size(), glm::vec3(leaning));
  const BuiltScan built = build_scan(points);
  EXPECT_EQ(built.stats.normals_estimated, 0U);
  EXPECT_GT(built.stats.smoothed, 0U);
  for (const uvec4& words : built.scene.data_pool)
    ASSERT_GT(glm::dot(unpack_splat(words).normal, leaning), 0.99999);
}

TEST(GridSurface, DoesNotDependOnOrderOrThreads) {
  const SimulatedScan scan = corner_by_depth_camera({.columns = 160, .rows = 120, .focal = 145.0});
  std::vector<std::uint32_t> order(scan.size());
  std::iota(order.begin(), order.end(), 0U);
  std::shuffle(order.begin(), order.end(), std::mt19937_64(3));
  Points shuffled = scan.points;
  for (std::size_t i = 0; i < order.size(); ++i) {
    shuffled.position[i] = scan.points.position[order[i]];
    shuffled.grid_cell[i] = scan.points.grid_cell[order[i]];
  }
  const BuiltScan one = build_scan(scan.points, {}, 1), other = build_scan(shuffled, {}, 4);
  EXPECT_GT(one.stats.smoothed, 0U);
  EXPECT_EQ(one.scene.data_pool, other.scene.data_pool);
}

/// Rendered depths, and range scans that are fine beside their grid, are as clean as other points.
TEST(GridSurface, CleanGridsAreNotMoved) {
  const SimulatedScan scan = corner_by_depth_camera({.step = 1e-6, .inverse_noise = 0.0});
  const BuiltScan built = build_scan(scan.points);
  EXPECT_EQ(built.stats.smoothed, 0U);
}

TEST(GridSurface, TheScenesCameraIsTheDepthCameras) {
  const SimulatedScan scan = corner_by_depth_camera();
  const Scene scene = build_scan(scan.points).scene;
  ASSERT_TRUE(scene.camera);
  const glm::dvec3 ahead = glm::normalize(scene.camera->target - scene.camera->eye);
  const glm::dvec3 truth = glm::normalize(glm::dvec3(0.9, 1.0, 0.6) - glm::dvec3(3.2, 3.0, 1.4));
  EXPECT_EQ(scene.camera->eye, glm::dvec3(3.2, 3.0, 1.4));
  EXPECT_GT(glm::dot(ahead, truth), 0.999999);
  EXPECT_GT(scene.camera->up.z, 0.8);
  EXPECT_NEAR(scene.camera->fov_y_deg, 2.0 * std::atan(120.0 / 290.0) * 180.0 / std::numbers::pi, 0.05);
}

/// Grids of the same points that no pinhole sees so.
TEST(GridSurface, OtherGridsHaveNoCamera) {
  SPLATRAY_NIGHTLY();
  const SimulatedScan room = scan_from_tripods(
      TriangleTree(room_mesh()), {.sensors = {{-0.3, 0.2, 1.6}}, .step_deg = 2.0, .highest_deg = 75.0}, {});
  EXPECT_FALSE(build_scan(room.points).scene.camera);
  Points turned = corner_by_depth_camera().points;
  for (glm::dvec3& position : turned.position) position = {position.y + 9.0, position.z, position.x};
  EXPECT_FALSE(build_scan(turned).scene.camera);
}

/// A terrestrial scanner's grid of angles; in space its noise would leave a median of 1 mm and 0.4 degrees.
TEST(GridSurface, TripodsAreSmoothedAlongTheirLinesOfSight) {
  SPLATRAY_NIGHTLY();
  const Tripod tripod{.sensors = {{-0.3, 0.2, 1.6}}, .step_deg = 0.5};
  const SimulatedScan scan = scan_from_tripods(TriangleTree(room_mesh()), tripod, {});
  const BuiltScan built = build_scan(scan.points);
  const Errors errors = errors_of(scan, built.scene, false);
  EXPECT_GT(drawn_share(scan, built.scene, PointKind::surface), 0.999);
  EXPECT_LT(at_share(errors.angles_deg, 0.5), 0.2);
  EXPECT_LT(at_share(errors.angles_deg, 0.95), 6.0);
  EXPECT_LT(at_share(errors.depths, 0.5), 0.0001);
  const glm::dvec3 sensor = tripod.sensors[0];
  for (std::size_t s = 0; s < built.scene.data_pool.size(); ++s) {
    const glm::dvec3 is = built.scene.root.to_world(unpack_splat(built.scene.data_pool[s]).center) - sensor;
    const glm::dvec3 was = scan.points.position[number_of(built.scene, s)] - sensor;
    ASSERT_LT(glm::length(glm::cross(is, glm::normalize(was))), 5e-5);
  }
}

/// Two cameras see one surface in two layers, which smoothing in space makes one of.
TEST(GridSurface, SeveralStationsAreSmoothedInSpace) {
  const SimulatedScan one = corner_by_depth_camera({.columns = 160, .rows = 120, .focal = 145.0});
  Points points = one.points;
  points.station.assign(points.size(), 0);
  for (std::size_t i = 0; i < one.size(); ++i) {
    points.position.push_back(one.points.position[i]);
    points.grid_cell.push_back(one.points.grid_cell[i]);
    points.station.push_back(1);
  }
  points.stations.push_back(points.stations[0]);
  const BuiltScan built = build_scan(points);
  EXPECT_FALSE(built.scene.camera);
  EXPECT_GT(built.stats.dropped_isolated, 0U);
}

/// Stereo on a table: depths are steps of disparity, 0.6 mm on the mug.
TEST(GridSurface, StereoKeepsItsPoints) {
  SPLATRAY_NIGHTLY();
  const char* folder = std::getenv("SPLATRAY_DATA_DIR");
  if (folder == nullptr) GTEST_SKIP() << "SPLATRAY_DATA_DIR is not set: no scan to read";
  BuildStats stats;
  const Scene scene = build_scene(
      read_input({std::filesystem::path(folder) / "scans/table_mug_stereo.pcd"}, {}), {}, 0, stats);
  EXPECT_EQ(stats.points_read, 209280U);
  EXPECT_EQ(stats.dropped_isolated, 0U);
  EXPECT_LT(stats.dropped_mixed, 1000U);
  ASSERT_TRUE(scene.camera);
  EXPECT_EQ(scene.camera->eye, glm::dvec3(0.0));
  EXPECT_NEAR(scene.camera->fov_y_deg, 2.0 * std::atan(240.0 / 964.36) * 180.0 / std::numbers::pi, 0.2);
  EXPECT_LT(scene.camera->up.y, -0.99);
}

}  // namespace
}  // namespace splatray::testing
