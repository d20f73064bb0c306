// Where a scanner stood: in a room by how dense its points are, in a depth camera's frame.
#include "preprocess/scan/station.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <random>

#include "engine/scene/scene_splat.h"
#include "preprocess/build_stats.h"
#include "preprocess/scan/sides.h"
#include "preprocess/surface/cloud.h"
#include "tests/scan_sim/built_scan.h"

namespace splatray::testing {
namespace {

const glm::dvec3 ROOM(4.0, 5.0, 3.0);

/// What a scanner that turns about z meets from a place in an empty closed room, with noise of 2 mm along its beams; one of so many
/// points, by chance.
void scan_room(const glm::dvec3& sensor, unsigned one_of, Points& points) {
  constexpr int ROWS = 180, COLUMNS = 360;
  std::mt19937_64 random(3);
  std::normal_distribution<double> noise(0.0, 0.002);
  for (int row = 0; row < ROWS; ++row)
    for (int column = 0; column < COLUMNS; ++column) {
      const double polar = std::numbers::pi * (row + 0.5) / ROWS,
                   turn = 2.0 * std::numbers::pi * column / COLUMNS;
      const glm::dvec3 dir(std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn),
                           std::cos(polar));
      double away = INFINITY;
      for (int axis = 0; axis < 3; ++axis)
        away = std::min(away, ((dir[axis] > 0.0 ? ROOM[axis] : 0.0) - sensor[axis]) / dir[axis]);
      if (random() % one_of != 0) continue;
      points.position.push_back(sensor + (away + noise(random)) * dir);
    }
}

/// As many points, as dense everywhere.
Points even_room() {
  Points points;
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const glm::dvec3 area(ROOM.y * ROOM.z, ROOM.z * ROOM.x, ROOM.x * ROOM.y);
  for (int i = 0; i < 60000; ++i) {
    const double chosen = unit(random) * (area.x + area.y + area.z);
    const int axis = chosen < area.x ? 0 : chosen < area.x + area.y ? 1 : 2;
    glm::dvec3 place = ROOM * glm::dvec3(unit(random), unit(random), unit(random));
    place[axis] = unit(random) < 0.5 ? 0.0 : ROOM[axis];
    points.position.push_back(place);
  }
  return points;
}

/// How far from a place the scanner was found; nothing where none was.
std::optional<double> found_off(Points points, const glm::dvec3& sensor) {
  BuildStats stats;
  Cloud cloud = make_cloud(std::move(points), false, true, stats);
  const Survey survey = survey_points(cloud, {0.0, 0.0, 1.0}, {"normals", {}});
  const std::optional<StationFound> found = find_scanner_place(cloud, survey);
  if (!found) return {};
  return glm::distance(cloud.center_world + cloud.half_extent_world * found->sensor, sensor);
}

double share_that_faces_origin(const BuiltScan& built) {
  std::size_t facing = 0;
  for_each_splat(built.scene, [&](std::size_t, const SceneSplat& splat) {
    facing += glm::dot(splat.normal(), splat.center_world()) < 0.0 ? 1 : 0;
  });
  return static_cast<double>(facing) / static_cast<double>(splat_count(built.scene));
}

TEST(FoundStation, IsTheScannersPlaceInWhateverUnitAndPose) {
  const glm::dvec3 sensor(1.2, 2.9, 1.4);
  Points scan;
  scan_room(sensor, 1, scan);
  EXPECT_LT(found_off(scan, sensor).value_or(INFINITY), 0.1);
  Points turned = scan;  // into feet, y up
  for (glm::dvec3& place : turned.position) place = glm::dvec3(place.y, place.z, place.x) / 0.3048;
  EXPECT_LT(found_off(turned, glm::dvec3(sensor.y, sensor.z, sensor.x) / 0.3048).value_or(INFINITY),
            0.1 / 0.3048);
  Points thinned;
  scan_room(sensor, 4, thinned);
  EXPECT_LT(found_off(thinned, sensor).value_or(INFINITY), 0.1);
}

TEST(FoundStation, IsNoneOfEvenPointsAndOfSeveralPlaces) {
  EXPECT_FALSE(found_off(even_room(), {}));
  Points both;
  scan_room({0.6, 0.7, 1.4}, 1, both);
  scan_room({3.4, 4.3, 1.4}, 1, both);
  EXPECT_FALSE(found_off(both, {}));
}

TEST(FoundStation, DecidesTheSidesOfARoom) {
  Points scan;
  scan_room({1.2, 2.9, 1.4}, 4, scan);  // so that no rings show it
  const BuiltScan built = build_scan(scan);
  EXPECT_GT(built.stats.station_explained, 0.8);
  EXPECT_EQ(built.stats.sides_by[static_cast<std::size_t>(SideRung::sensor)], 1U);
  const BuiltScan even = build_scan(even_room());
  EXPECT_EQ(even.stats.station_explained, 0.0);
  EXPECT_EQ(even.stats.sides_by[static_cast<std::size_t>(SideRung::votes)], 1U);
}

/// A cave about the origin as a scanner with a narrow field saw it, whose rings thinning has broken: no room, and rays leave it above.
TEST(FoundStation, DecidesTheSidesOfACave) {
  Points seen;
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int i = 0; i < 30000; ++i) {
    const double turn = std::numbers::pi * unit(random), rise = std::numbers::pi / 6.0 * unit(random);
    const double away = 4.0 + std::cos(2.0 * turn) + 0.4 * std::sin(3.0 * turn) + 0.3 * std::sin(9.0 * rise);
    seen.position.push_back(
        away * glm::dvec3(std::cos(rise) * std::cos(turn), std::cos(rise) * std::sin(turn), std::sin(rise)));
  }
  const BuiltScan built = build_scan(seen);
  EXPECT_GT(share_that_faces_origin(built), 0.97);
  ASSERT_TRUE(built.scene.stations.at(0).sensor_found_world);
  EXPECT_LT(glm::length(*built.scene.stations[0].sensor_found_world), 0.3) << "views stand there";
  EXPECT_FALSE(built.scene.stations[0].sensor_world) << "no file says so";
}

/// A table before a wall, seen from the origin along z; votes of rays take it for whatever lies around more room.
TEST(FoundStation, IsTheOriginOfADepthCamerasFrame) {
  Points seen;
  for (int row = 0; row < 120; ++row)
    for (int column = 0; column < 160; ++column) {
      const glm::dvec3 dir(0.004 * (column - 80), 0.004 * (row - 60), 1.0);
      const double to_table = dir.y > 0.0 ? 0.4 / dir.y : INFINITY;
      seen.position.push_back(std::min(3.0 + 0.3 * dir.x, to_table) * dir);
    }
  const BuiltScan built = build_scan(seen, {}, 0, std::nullopt);
  EXPECT_EQ(built.stats.sides_by[static_cast<std::size_t>(SideRung::sensor)], 1U);
  EXPECT_GT(share_that_faces_origin(built), 0.99);
}

/// A room of 8 x 6 x 3 as a scanner at the origin saw it, one point for each step of both angles, each stored twice.
Points spun_room() {
  constexpr int ROWS = 180, COLUMNS = 330;
  const glm::dvec3 low(-3.0, -2.0, -1.3), high(5.0, 4.0, 1.7);
  Points seen;
  for (int row = 0; row < ROWS; ++row)
    for (int column = 0; column < COLUMNS; ++column) {
      const double rise = std::numbers::pi * ((row + 0.5) / ROWS - 0.5),
                   turn = 2.0 * std::numbers::pi * column / COLUMNS;
      const glm::dvec3 dir(std::cos(rise) * std::cos(turn), std::cos(rise) * std::sin(turn), std::sin(rise));
      double away = INFINITY;
      for (int axis = 0; axis < 3; ++axis)
        if (dir[axis] != 0.0) away = std::min(away, (dir[axis] > 0.0 ? high : low)[axis] / dir[axis]);
      seen.position.insert(seen.position.end(), 2, away * dir);
    }
  return seen;
}

TEST(FoundStation, IsTheOriginThatRingsRunAround) {
  Input input;
  input.objects.resize(1);
  input.objects[0].points = spun_room();
  const std::size_t stored = input.objects[0].points.size();
  BuiltScan built;
  built.scene = build_scene(std::move(input), {}, 0, built.stats);
  EXPECT_EQ(built.stats.dropped_duplicates, stored / 2) << "copies hide the steps along rings";
  ASSERT_TRUE(built.scene.stations.at(0).sensor_found_world);
  EXPECT_LT(glm::length(*built.scene.stations[0].sensor_found_world), 1e-6);
  EXPECT_GT(share_that_faces_origin(built), 0.99);
  std::size_t floor = 0, closed = 0;  // out where rings are far from each other
  for (const uvec4& words : built.scene.data_pool) {
    const Splat splat = unpack_splat(words);
    const glm::dvec3 place = built.scene.root.to_world(splat.center);
    const double away = std::hypot(place.x, place.y);
    if (place.z > -1.29 || away < 2.0 || away > 3.5) continue;
    const double gap = (away * away + 1.3 * 1.3) / 1.3 * std::numbers::pi / 180.0;  // to the next ring
    ++floor;
    closed += std::sqrt(splat.radius_squared) * built.scene.root.unit_world >= 0.5 * gap ? 1 : 0;
  }
  ASSERT_GT(floor, 1000U);
  EXPECT_GT(static_cast<double>(closed), 0.95 * static_cast<double>(floor));
}

/// A thing whose rows are 200 points round, at heights of 0.02 from -1.2 on, each as far from z as `radius_of` says.
template <class RadiusOf>
Points rows_of(const RadiusOf& radius_of) {
  Points thing;
  for (int row = 0; row <= 120; ++row)
    for (int column = 0; column < 200; ++column) {
      const double turn = 2.0 * std::numbers::pi * column / 200.0, radius = radius_of(row, column);
      thing.position.emplace_back(radius * std::cos(turn), radius * std::sin(turn), 0.02 * (row - 60));
    }
  return thing;
}

TEST(FoundStation, IsNoneInWhatWasTurnedOrMilled) {
  const auto vase = [](int row, int) { return 0.6 + 0.2 * std::sin(0.06 * row); };
  const auto spool = [](int row, int) { return row < 10 || row > 110 ? 1.0 : 0.5; };
  const auto gear = [](int, int column) { return column / 10 % 2 == 0 ? 1.0 : 0.5; };
  for (const Points& thing : {rows_of(vase), rows_of(spool), rows_of(gear)}) {
    const BuiltScan built = build_scan(thing);
    EXPECT_EQ(built.stats.sides_by[static_cast<std::size_t>(SideRung::sensor)], 0U);
  }
}

TEST(FoundStation, IsTheOriginThatRingsRunAroundDespiteNoise) {
  Points seen = spun_room();
  std::mt19937_64 random(3);
  std::normal_distribution<double> angle(0.0, 5e-4), range(0.0, 0.002);  // rings are 17 mrad apart
  for (glm::dvec3& place : seen.position) {
    const double away = glm::length(place) + range(random);
    const glm::dvec3 turned =
        place + glm::length(place) * glm::dvec3(angle(random), angle(random), angle(random));
    place = away * glm::normalize(turned);
  }
  const BuiltScan built = build_scan(seen);
  ASSERT_TRUE(built.scene.stations.at(0).sensor_found_world);
  EXPECT_LT(glm::length(*built.scene.stations[0].sensor_found_world), 1e-6);
  EXPECT_GT(share_that_faces_origin(built), 0.99);
}

}  // namespace
}  // namespace splatray::testing
