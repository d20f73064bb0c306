// What preprocess makes of simulated scans: strays, sides, noise.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include "engine/scene/splat.h"
#include "preprocess/scan/sides.h"
#include "tests/all_tests.h"
#include "tests/scan_sim/built_scan.h"
#include "tests/scan_sim/scanner.h"
#include "tests/scan_sim/sim_meshes.h"

namespace splatray::testing {
namespace {

/// Shares of the points of each kind that are drawn, and of right sides among surface points.
struct Shares {
  double surface = 0.0, mixed = 0.0, stray = 0.0, right = 0.0;
};

Shares shares_of(const SimulatedScan& scan, const Scene& scene) {
  std::array<double, POINT_KINDS> all{}, drawn{};
  for (const PointKind kind : scan.kind) all[static_cast<std::size_t>(kind)] += 1.0;
  const Column& number = *find_column(scene.columns, POINT_NUMBER);
  double right = 0.0;
  for (std::size_t s = 0; s < scene.data_pool.size(); ++s) {
    const auto i = static_cast<std::size_t>(number.number(s));
    drawn[static_cast<std::size_t>(scan.kind[i])] += 1.0;
    if (scan.kind[i] != PointKind::surface) continue;
    right += glm::dot(unpack_splat(scene.data_pool[s]).normal, scan.normal[i]) > 0.0 ? 1.0 : 0.0;
  }
  for (std::size_t kind = 0; kind < all.size(); ++kind) drawn[kind] /= std::max(all[kind], 1.0);
  return {drawn[0], drawn[1], drawn[2], right / std::max(drawn[0] * all[0], 1.0)};
}

SimulatedScan ball_scan(const Beam& beam = {.noise = 0.0005}) {
  return range_images(TriangleTree(sphere_mesh(4)), {.views = 6, .pixels = 60, .misplaced = 0.0}, beam);
}

SimulatedScan room_scan(double step_deg = 1.5) {
  const Tripod tripod{.sensors = {{-0.3, 0.2, 1.6}}, .step_deg = step_deg, .highest_deg = 75.0};
  return scan_from_tripods(TriangleTree(room_mesh()), tripod, {.stray_share = 0.003});
}

SimulatedScan without_stations(SimulatedScan scan) {
  scan.points.stations.clear();
  scan.points.station.clear();
  scan.points.grid_cell.clear();
  return scan;
}

TEST(ScanSurface, StraysAndMixedPixelsAreNotDrawn) {
  SPLATRAY_NIGHTLY();
  const SimulatedScan scan = room_scan(0.5);
  const BuiltScan built = build_scan(scan.points);
  const Shares shares = shares_of(scan, built.scene);
  EXPECT_GT(shares.surface, 0.96);
  EXPECT_LT(shares.stray, 0.05);
  EXPECT_LT(shares.mixed, 0.3);
  EXPECT_EQ(built.stats.dropped_isolated + built.stats.dropped_mixed + built.stats.dropped_unsupported,
            scan.size() - built.scene.data_pool.size());
}

/// The noise is along the beam; off the surface it is less where a beam grazes.
TEST(ScanSurface, NoiseAndStepOfEachStationAreKept) {
  for (const double noise : {0.001, 0.004}) {
    const Tripod tripod{
        .sensors = {{-0.3, 0.2, 1.6}, {0.4, -0.2, 1.5}}, .step_deg = 2.0, .highest_deg = 75.0};
    SimulatedScan scan = scan_from_tripods(TriangleTree(room_mesh()), tripod, {.noise = noise});
    for (std::size_t i = 0; i < scan.size(); ++i) {
      const double step = scan.points.station[i] == 0 ? 0x1p-13 : 0x1p-11;
      scan.points.position[i] = glm::round(scan.points.position[i] / step) * step;
    }
    const Scene scene = build_scan(scan.points).scene;
    ASSERT_EQ(scene.stations.size(), 2U);
    EXPECT_EQ(scene.stations[0].step_world, 0x1p-13);
    EXPECT_EQ(scene.stations[1].step_world, 0x1p-11);
    for (const Station& station : scene.stations) {
      EXPECT_GT(station.noise_world, 0.5 * noise);
      EXPECT_LT(station.noise_world, 1.5 * noise);
    }
  }
}

TEST(ScanSurface, SidesAreTheSensors) {
  const SimulatedScan scan = ball_scan();
  const BuiltScan built = build_scan(scan.points);
  EXPECT_EQ(built.stats.sides_by[static_cast<std::size_t>(SideRung::sensor)], 1U);
  EXPECT_GT(shares_of(scan, built.scene).right, 0.995);
}

TEST(ScanSurface, SensorsOnTheOtherSideTurnTheNormals) {
  SimulatedScan scan = ball_scan();
  for (Station& station : scan.points.stations) station.sensor_world = glm::dvec3(0.0);
  EXPECT_LT(shares_of(scan, build_scan(scan.points).scene).right, 0.005);
}

TEST(ScanSurface, VotesFindOutsidesOfBodies) {
  const SimulatedScan scan = without_stations(ball_scan());
  const BuiltScan built = build_scan(scan.points);
  EXPECT_EQ(built.stats.sides_by[static_cast<std::size_t>(SideRung::votes)], 1U);
  EXPECT_GT(shares_of(scan, built.scene).right, 0.97);
}

TEST(ScanSurface, VotesFindInsidesOfRooms) {
  const SimulatedScan scan = without_stations(room_scan());
  EXPECT_GT(shares_of(scan, build_scan(scan.points).scene).right, 0.9);
}

TEST(ScanSurface, PulsesShowTheTrack) {
  const SimulatedScan scan =
      scan_from_air(TriangleTree(terrain_mesh()), {.from_x = -45.0, .to_x = 45.0, .spacing = 0.8},
                    {.noise = 0.02, .divergence = 2e-3});
  const BuiltScan built = build_scan(scan.points);
  EXPECT_EQ(built.stats.sides_by[static_cast<std::size_t>(SideRung::track)], 1U);
  EXPECT_GT(shares_of(scan, built.scene).right, 0.98);
}

/// Root mean square of the points' distances from the unit sphere.
double roughness(const Scene& scene) {
  double sum = 0.0;
  for (const uvec4& words : scene.data_pool) {
    const double off = glm::length(scene.root.to_world(unpack_splat(words).center)) - 1.0;
    sum += off * off;
  }
  return std::sqrt(sum / static_cast<double>(scene.data_pool.size()));
}

TEST(ScanSurface, NoiseIsSmoothedUnlessThatIsOff) {
  const TriangleTree ball(sphere_mesh(6));
  const SimulatedScan scan =
      range_images(ball, {.views = 6, .pixels = 120, .misplaced = 0.0}, {.noise = 0.005, .stray_share = 0.0});
  const BuiltScan smoothed = build_scan(scan.points);
  const BuiltScan rough = build_scan(scan.points, {.smooth_world = 0.0});
  EXPECT_GT(smoothed.stats.smoothed, 0U);
  EXPECT_EQ(rough.stats.smoothed, 0U);
  EXPECT_LT(roughness(smoothed.scene), 0.5 * roughness(rough.scene));
}

/// Of the drawn points that are truly of a kind, the share that the build says to be of surfaces.
double surface_share(const SimulatedScan& scan, const Scene& scene, PointKind truth) {
  const Column& number = *find_column(scene.columns, POINT_NUMBER);
  const Column* kinds = find_column(scene.columns, COLUMN_KIND);
  double all = 0.0, surface = 0.0;
  for (std::size_t s = 0; s < scene.data_pool.size(); ++s) {
    if (scan.kind[static_cast<std::size_t>(number.number(s))] != truth) continue;
    all += 1.0;
    surface += kinds == nullptr || kinds->number(s) == 0.0 ? 1.0 : 0.0;
  }
  return surface / std::max(all, 1.0);
}

TEST(ScanKinds, LeavesAreScatterAndTheHillIsNot) {
  Wood wood = wood_mesh();
  SimulatedScan scan = wood_scan(TriangleTree(std::move(wood.mesh)));
  mark_leaves(scan, wood.first_leaf);
  const BuiltScan built = build_scan(scan.points);
  EXPECT_GT(surface_share(scan, built.scene, PointKind::surface), 0.98);
  EXPECT_LT(surface_share(scan, built.scene, PointKind::leaf), 0.05);
  std::uint64_t counted = 0;
  for (const std::uint64_t count : built.stats.kinds) counted += count;
  EXPECT_EQ(counted,
            built.scene.data_pool.size() + built.stats.dropped_duplicates + built.stats.dropped_unsupported);
}

TEST(ScanKinds, RoomsAndNoiseAreSurfaces) {
  for (const SimulatedScan& scan : {room_scan(0.5), ball_scan(), ball_scan({.noise = 0.01})})
    EXPECT_GT(surface_share(scan, build_scan(scan.points).scene, PointKind::surface), 0.97);
}

TEST(ScanKinds, WhereAllIsSurfaceNothingIsKept) {
  const BuiltScan built = build_scan(ball_scan({.noise = 0.0, .stray_share = 0.0}).points);
  EXPECT_EQ(find_column(built.scene.columns, COLUMN_KIND), nullptr);
  EXPECT_EQ(built.stats.kinds[1] + built.stats.kinds[2], 0U);
}

/// Points of a sphere without noise, with normals, as no mesh's.
InputObject clean_points() {
  InputObject object;
  object.material = default_material();
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 20000; ++i) {
    const glm::dvec3 p = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
    object.points.position.push_back(p);
    object.points.normal.emplace_back(p);
  }
  return object;
}

TEST(ScanSurface, CleanPointsStayBitForBit) {
  Scene scenes[2];
  for (const bool measured : {true, false}) {
    Input input;
    input.objects.push_back(clean_points());
    input.objects[0].measured = measured;  // points that were made are never touched
    BuildStats stats;
    scenes[measured ? 0 : 1] = build_scene(std::move(input), {}, 0, stats);
    EXPECT_EQ(stats.smoothed + stats.dropped_isolated + stats.dropped_mixed, 0U);
  }
  EXPECT_EQ(scenes[0].data_pool, scenes[1].data_pool);
  EXPECT_EQ(scenes[0].field_pool, scenes[1].field_pool);
}

/// Where a surface is at two parameters in [0, 1).
using SurfaceAt = glm::dvec3 (*)(double u, double v);

double turns(double share) { return 2.0 * std::numbers::pi * share; }

/// A ring whose tube is as thick as the points are apart.
glm::dvec3 thin_torus(double u, double v) {
  const double out = 1.0 + 0.02 * std::cos(turns(v));
  return {out * std::cos(turns(u)), out * std::sin(turns(u)), 0.02 * std::sin(turns(v))};
}

/// A band of 0.1 that winds about the vertical axis 20 times, like a drill's flute.
glm::dvec3 screw(double u, double v) {
  const double radius = 0.02 + 0.1 * v;
  return {radius * std::cos(turns(20.0 * u)), radius * std::sin(turns(20.0 * u)), 2.0 * u};
}

/// A cube with round edges, as a superquadric.
glm::dvec3 superquadric(double u, double v) {
  const auto bent = [](double w) { return std::copysign(std::pow(std::abs(w), 0.25), w); };
  const double latitude = std::numbers::pi * (v - 0.5), longitude = turns(u);
  return {bent(std::cos(latitude)) * bent(std::cos(longitude)),
          bent(std::cos(latitude)) * bent(std::sin(longitude)), bent(std::sin(latitude))};
}

/// Exact points of a surface; their normals are those of the form.
InputObject exact_points(SurfaceAt at) {
  InputObject object;
  object.material = default_material();
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> unit(0.001, 0.999);
  constexpr double STEP = 1e-7;
  for (int i = 0; i < 20000; ++i) {
    const double u = unit(random), v = unit(random);
    const glm::dvec3 p = at(u, v);
    const glm::dvec3 normal = glm::cross(at(u + STEP, v) - p, at(u, v + STEP) - p);
    object.points.position.push_back(p);
    object.points.normal.emplace_back(glm::normalize(normal));
  }
  return object;
}

BuiltScan built_of(InputObject object, double smooth_world) {
  Input input;
  input.objects.push_back(std::move(object));
  BuiltScan built;
  built.scene = build_scene(std::move(input), {.smooth_world = smooth_world}, 0, built.stats);
  return built;
}

TEST(ScanSurface, GivenNormalsStayBitForBitHoweverTheSurfaceBends) {
  for (const SurfaceAt at : {thin_torus, screw, superquadric}) {
    const BuiltScan by_default = built_of(exact_points(at), -1.0), off = built_of(exact_points(at), 0.0);
    EXPECT_EQ(by_default.stats.smoothed, 0U);
    EXPECT_EQ(by_default.scene.data_pool, off.scene.data_pool);
    EXPECT_EQ(by_default.scene.field_pool, off.scene.field_pool);
    EXPECT_EQ(by_default.scene.clip_pool, off.scene.clip_pool);
  }
}

TEST(ScanSurface, GivenNormalsAreSmoothedWhereThatIsAskedFor) {
  EXPECT_GT(built_of(exact_points(screw), 0.01).stats.smoothed, 0U);
}

/// A clean half with normals beside a noisy one without.
TEST(ScanSurface, GivenNormalsStayBesideNoise) {
  SimulatedScan scan =
      range_images(TriangleTree(sphere_mesh(6)), {.views = 6, .pixels = 120, .misplaced = 0.0},
                   {.noise = 0.005, .stray_share = 0.0});
  Points& points = scan.points;
  points.normal.resize(points.size(), glm::vec3(0.0F));
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points.position[i].x < 0.0) continue;
    points.position[i] = glm::normalize(points.position[i]);
    points.normal[i] = glm::vec3(points.position[i]);
  }
  const BuiltScan smoothed = build_scan(scan.points);
  EXPECT_GT(smoothed.stats.smoothed, scan.size() / 3);
  EXPECT_LT(smoothed.stats.smoothed, scan.size() * 2 / 3);
  const Column& number = *find_column(smoothed.scene.columns, POINT_NUMBER);
  for (std::size_t s = 0; s < smoothed.scene.data_pool.size(); ++s) {
    const auto i = static_cast<std::size_t>(number.number(s));
    if (points.position[i].x < 0.0) continue;
    const Splat splat = unpack_splat(smoothed.scene.data_pool[s]);
    ASSERT_LT(glm::distance(smoothed.scene.root.to_world(splat.center), points.position[i]), 1e-5);
    ASSERT_GT(glm::dot(splat.normal, points.position[i]), 0.99999);
  }
}

/// A ball that six scanners see, with normals that lean by about 15 degrees, as those of a noisy grid do.
SimulatedScan noisy_ball_with_normals(double noise) {
  SimulatedScan scan =
      range_images(TriangleTree(sphere_mesh(6)), {.views = 6, .pixels = 120, .misplaced = 0.0},
                   {.noise = noise, .stray_share = 0.0});
  std::mt19937_64 random(5);
  std::normal_distribution<double> lean(0.0, 0.2);
  for (const glm::dvec3& normal : scan.normal)
    scan.points.normal.emplace_back(
        glm::normalize(normal + glm::dvec3(lean(random), lean(random), lean(random))));
  return scan;
}

/// Degrees by which splats' normals are off those of the unit ball, ascending.
std::vector<double> ball_angles(const Scene& scene) {
  std::vector<double> angles;
  for (const uvec4& words : scene.data_pool) {
    const glm::dvec3 out = glm::normalize(scene.root.to_world(unpack_center(words)));
    angles.push_back(
        glm::degrees(std::acos(std::clamp(glm::dot(unpack_splat(words).normal, out), -1.0, 1.0))));
  }
  std::sort(angles.begin(), angles.end());
  return angles;
}

TEST(ScanSurface, NoisyNormalsThatAreGivenAreTakenAnewOnTheirSides) {
  SimulatedScan scan = without_stations(noisy_ball_with_normals(0.004));
  for (glm::vec3& normal : scan.points.normal)
    normal = -normal;  // a mould: sides are the file's, whatever they are
  const BuiltScan built = build_scan(scan.points);
  EXPECT_GT(built.stats.smoothed, scan.size() * 9 / 10);
  const std::vector<double> angles = ball_angles(built.scene);
  EXPECT_GT(angles[angles.size() / 100], 170.0) << "a side was lost";
  EXPECT_GT(angles[angles.size() / 20], 176.0);
  EXPECT_EQ(built.stats.normals_estimated, 0U);
}

TEST(ScanSurface, LeaningNormalsOfExactPointsStay) {
  const SimulatedScan scan = noisy_ball_with_normals(0.0);
  const BuiltScan built = build_scan(scan.points), off = build_scan(scan.points, {.smooth_world = 0.0});
  EXPECT_EQ(built.stats.smoothed, 0U);
  EXPECT_EQ(built.scene.data_pool, off.scene.data_pool);
}

TEST(ScanSurface, DoesNotDependOnOrderOrThreads) {
  SimulatedScan scan = room_scan();
  const BuiltScan one = build_scan(scan.points, {}, 1);
  std::vector<std::uint32_t> order(scan.size());
  std::iota(order.begin(), order.end(), 0U);
  std::shuffle(order.begin(), order.end(), std::mt19937_64(3));
  SimulatedScan shuffled = scan;
  for (std::size_t i = 0; i < order.size(); ++i) {
    shuffled.points.position[i] = scan.points.position[order[i]];
    shuffled.points.station[i] = scan.points.station[order[i]];
    shuffled.points.grid_cell[i] = scan.points.grid_cell[order[i]];
  }
  const BuiltScan other = build_scan(shuffled.points, {}, 4);
  EXPECT_EQ(one.scene.data_pool, other.scene.data_pool);
  EXPECT_EQ(one.scene.reference_pool, other.scene.reference_pool);
}

/// Seven points, six of them at one place: smoothing once left none of them, and an octree without a splat.
TEST(ScanSurface, TooSmallARadiusLeavesThePointsAsTheyAre) {
  for (const double smooth_world : {-1.0, 1e-3, 10.0}) {
    Input input;
    Points& points = input.objects.emplace_back().points;
    points.position.assign(6, glm::dvec3(1.0, 2.0, 3.0));
    points.position.emplace_back(0.0, 0.0, 0.0);
    BuildParams params;
    params.smooth_world = smooth_world;
    BuildStats stats;
    EXPECT_GE(build_scene(std::move(input), params, 1, stats).data_pool.size(), 2U) << smooth_world;
  }
}

}  // namespace
}  // namespace splatray::testing
