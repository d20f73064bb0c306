/// Points far from all others: found before anything is scaled by the box that they are in, and nothing else taken for such.
#include "preprocess/base/far_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "engine/base/error.h"
#include "engine/scene/splat.h"
#include "preprocess/clouds.h"
#include "tests/all_tests.h"
#include "tests/preprocess/shapes.h"

namespace splatray {
namespace {

using glm::dvec3;

/// Points of a curved sheet, 5 across, without normals.
std::vector<dvec3> sheet_points(std::size_t count, const dvec3& middle = dvec3(0.0)) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> side(-2.5, 2.5);
  std::vector<dvec3> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = side(random), y = side(random);
    points.push_back(middle + dvec3(x, y, 0.3 * std::sin(x) * std::cos(y)));
  }
  return points;
}

std::vector<dvec3> operator+(std::vector<dvec3> points, const std::vector<dvec3>& more) {
  points.insert(points.end(), more.begin(), more.end());
  return points;
}

std::vector<std::uint32_t> far_of(const std::vector<dvec3>& points) {
  return find_far_points(points).numbers;
}

Input scan_of(std::vector<dvec3> points) {
  InputObject object;
  object.name = "scan";
  object.points.position = std::move(points);
  return test::input_of(std::move(object));
}

bool has_note(const BuildStats& stats, const std::string& text) {
  return std::any_of(stats.notes.begin(), stats.notes.end(),
                     [&](const std::string& note) { return note.find(text) != std::string::npos; });
}

TEST(FarPoints, AHandfulFarAwayIsFoundWhereverItIs) {
  const std::vector<std::uint32_t> last{7000};
  for (const dvec3& wild :
       {dvec3(1e8, 0.0, 0.0), dvec3(0.0, -4e11, 0.0), dvec3(0.0, 0.0, 1e99), dvec3(200.0)})
    EXPECT_EQ(far_of(sheet_points(7000) + std::vector{wild}), last)
        << wild.x << " " << wild.y << " " << wild.z;
  EXPECT_EQ(far_of(sheet_points(7000, dvec3(5e5, 5.2e6, 100.0)) + std::vector{dvec3(0.0)}), last);
  const FarPoints far = find_far_points(
      sheet_points(7000) + std::vector{dvec3(1e3, 0.0, 0.0), dvec3(0.0, 1e9, 0.0), dvec3(-1e6, 1e4, 0.0)});
  EXPECT_EQ(far.numbers, (std::vector<std::uint32_t>{7000, 7001, 7002}));
  EXPECT_NEAR(far.nearest_world, 997.5, 0.1);
  EXPECT_NEAR(far.farthest_world, 1e9, 5.0);
  EXPECT_NEAR(far.others.high.x, 2.5, 0.01);
}

TEST(FarPoints, OneOfAHundredPointsIsAHandfulButOneOfTenIsNot) {
  EXPECT_EQ(far_of(sheet_points(99) + std::vector{dvec3(1e5)}).size(), 1U);
  EXPECT_EQ(far_of(sheet_points(9) + std::vector{dvec3(1e5)}).size(), 0U);
}

TEST(FarPoints, ManyAtOnePlaceAreWhatAScannerWritesForNothing) {
  const std::vector<dvec3> zeros(1500, dvec3(0.0));
  EXPECT_EQ(far_of(sheet_points(7000, dvec3(5e5, 5.2e6, 100.0)) + zeros).size(), 1500U);
}

TEST(FarPoints, WhatBelongsToTheSceneStays) {
  EXPECT_TRUE(far_of({}).empty());
  EXPECT_TRUE(far_of(sheet_points(7000)).empty());
  EXPECT_TRUE(far_of(sheet_points(7000) + std::vector{dvec3(50.0, 0.0, 0.0)}).empty())
      << "10 times the extent";
  EXPECT_TRUE(far_of(sheet_points(7000) + sheet_points(500, dvec3(200.0, 0.0, 0.0))).empty())
      << "two stations";
  EXPECT_TRUE(far_of(sheet_points(7000) + sheet_points(20, dvec3(4e4, 0.0, 0.0))).empty()) << "no handful";
  EXPECT_TRUE(far_of(std::vector<dvec3>(5000, dvec3(1.0)) + std::vector{dvec3(2.0)}).empty()) << "no scale";
  std::vector<dvec3> line;  // towers of a power line, 300 apart, and a sparse wire
  for (int tower = 0; tower < 6; ++tower) line = line + sheet_points(300, dvec3(300.0 * tower, 0.0, 0.0));
  for (int i = 0; i < 40; ++i) line.emplace_back(37.5 * i, 0.0, 20.0);
  EXPECT_TRUE(far_of(line).empty());
}

/// As a scanner sees a plain: density falls with the square of the distance, the last points are lone.
TEST(FarPoints, TheThinEndOfAScanStays) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<dvec3> points;
  for (int i = 0; i < 20000; ++i) {
    const double range = 2.0 / (1.0 - 0.998 * unit(random)), turn = 6.28 * unit(random);
    points.emplace_back(range * std::cos(turn), range * std::sin(turn), 0.0);
  }
  EXPECT_TRUE(far_of(points).empty());
}

TEST(FarPoints, TheOrderOfPointsDoesNotMatter) {
  std::vector<dvec3> points =
      sheet_points(3000) + std::vector{dvec3(1e7), dvec3(-120.0, 0.0, 0.0), dvec3(90.0)};
  const auto places = [&] {
    std::vector<double> found;
    for (const std::uint32_t i : far_of(points)) found.push_back(points[i].x);
    std::sort(found.begin(), found.end());
    return found;
  };
  const std::vector<double> before = places();
  EXPECT_EQ(before, (std::vector{-120.0, 1e7}));
  std::shuffle(points.begin(), points.end(), std::mt19937_64(5));
  EXPECT_EQ(places(), before);
}

TEST(FarPoints, AScanIsBuiltAsIfTheyWereNotThere) {
  const dvec3 utm(5e5, 5.2e6, 100.0);
  BuildStats with, without;
  const Scene spoilt = build_scene(
      scan_of(std::vector{dvec3(0.0)} + sheet_points(4000, utm) + std::vector{dvec3(1e80)}), {}, 0, with);
  const Scene clean = build_scene(scan_of(sheet_points(4000, utm)), {}, 0, without);
  EXPECT_EQ(spoilt.data_pool, clean.data_pool);
  EXPECT_EQ(spoilt.node_pool, clean.node_pool);
  EXPECT_EQ(spoilt.root.unit_world, clean.root.unit_world);
  EXPECT_EQ(with.dropped_far, 2U);
  EXPECT_TRUE(has_note(with,
                       "object 'scan': 2 points were left out: they lie 5.2e+06 to 1e+80 away from all "
                       "others, which are 5 across"))
      << with.notes.at(0);
  EXPECT_TRUE(without.notes.empty());
  EXPECT_EQ(without.dropped_far, 0U);
}

/// Two scans' worth of clouds, both whole.
TEST(FarPoints, WhatWasNotMeasuredIsKeptAndTheLossReported) {
  InputObject ball = test::even_sphere(2000);
  ball.points.position.emplace_back(1e5, 0.0, 0.0);
  ball.points.normal.emplace_back(1.0F, 0.0F, 0.0F);
  BuildStats stats;
  (void)build_scene(test::input_of(std::move(ball)), {}, 0, stats);
  EXPECT_EQ(stats.dropped_far, 0U);
  EXPECT_EQ(stats.splats + stats.dropped_duplicates, 2001U);
  EXPECT_TRUE(
      has_note(stats, "1 point lies 1e+05 away from all others, which are 2 across; it blurs the others"));
}

TEST(FarPoints, ObjectsTooSmallForTheSceneAreReported) {
  Input input = test::input_of(test::even_sphere(500));
  input.objects[0].name = "ball";
  InputObject field = test::square_lattice(30, 1e3);
  field.surface_area = 9e8;
  input.objects.push_back(std::move(field));
  BuildStats stats;
  (void)build_scene(std::move(input), {}, 0, stats);
  EXPECT_TRUE(has_note(stats, "object 'ball' is 2 across in a scene whose coordinates have steps of"));
  EXPECT_EQ(stats.notes.size(), 1U);
}

TEST(FarPoints, NoPointLeftSaysWhatBecameOfThem) {
  const auto refusal = [](std::vector<dvec3> points) -> std::string {
    BuildStats stats;
    try {
      (void)build_scene(scan_of(std::move(points)), {}, 0, stats);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::input_unreadable);
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refusal({}), "the input has no points, expected at least one");
  EXPECT_EQ(
      refusal({dvec3(1e300)}),
      "the input has no usable point: found 1 point with positions that are not finite or beyond 1e100, "
      "expected at least one other");
  BuildStats stats;
  stats.points_read = 7;
  stats.dropped_non_finite = 1;
  stats.dropped_far = 2;
  stats.dropped_mixed = 4;
  try {
    require_points({}, stats);
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(
        error.what(),
        "the input has no point on a surface: found 7 points, of them 1 not finite or beyond 1e100, 2 "
        "far from all others, 4 between two surfaces, expected at least one other");
  }
}

/// A grid of a plane that is met without any noise: its points lie on straight lines exactly, one of them does not.
TEST(FarPoints, GridsWithoutNoiseKeepTheirPoints) {
  constexpr std::uint32_t SIDE = 40;
  InputObject object;
  Points& points = object.points;
  for (std::uint32_t cell = 0; cell < SIDE * SIDE; ++cell) {
    const double range = cell == 777 ? 1e8 : 4.0;
    const double x = 0.02 * (cell % SIDE) - 0.4, z = 0.02 * (cell / SIDE) - 0.4;
    points.position.push_back(range * dvec3(x, 1.0, z));
    points.grid_cell.push_back(cell);
  }
  points.stations = {{"s", dvec3(0.0), SIDE, SIDE}};
  BuildStats stats;
  (void)build_scene(test::input_of(std::move(object)), {}, 0, stats);
  EXPECT_EQ(stats.dropped_far, 1U);
  EXPECT_LT(stats.dropped_isolated + stats.dropped_mixed, 100U);
}

/// Pulses of two returns whose times are so large that half a second is lost in them.
TEST(FlightTrack, TimesInNanosecondsEnd) {
  InputObject object;
  std::vector<std::uint8_t> number, returns;
  std::vector<double> time;
  for (int pulse = 0; pulse < 400; ++pulse) {
    for (const int which : {1, 2}) {
      object.points.position.emplace_back(pulse % 20, pulse / 20, 3.0 - which);
      number.push_back(static_cast<std::uint8_t>(which));
      returns.push_back(2);
      time.push_back(1.7e18 + 1024.0 * pulse);
    }
  }
  object.points.columns = {{std::string(COLUMN_RETURN), number},
                           {std::string(COLUMN_RETURNS), returns},
                           {std::string(COLUMN_TIME), time}};
  BuildStats stats;
  (void)build_scene(test::input_of(std::move(object)), {}, 0, stats);
  EXPECT_GT(stats.splats, 0U);
}

/// Equal points are distinguished by their attributes, of which some are no numbers.
TEST(Build, AttributesThatAreNoNumbersHaveAnOrder) {
  const auto built = [](std::uint64_t seed) {
    InputObject object;
    std::vector<std::uint32_t> order(600);
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    std::shuffle(order.begin(), order.end(), std::mt19937_64(seed));
    std::vector<double> values;
    for (const std::uint32_t i : order) {
      object.points.position.emplace_back(i % 200, 0.1 * ((i % 200) % 7), 0.0);
      values.push_back(i % 3 == 0 ? std::numeric_limits<double>::quiet_NaN() : double(i));
    }
    object.points.columns = {{"value", values}};
    BuildStats stats;
    return build_scene(test::input_of(std::move(object)), {}, 0, stats);
  };
  const Scene a = built(1), b = built(2);
  ASSERT_EQ(a.columns.at(0).size(), b.columns.at(0).size());
  for (std::size_t i = 0; i < a.columns[0].size(); ++i) {
    const double x = a.columns[0].number(i), y = b.columns[0].number(i);
    EXPECT_TRUE(x == y || (std::isnan(x) && std::isnan(y))) << i;
  }
}

/// Standard deviation of the heights in the middle of waves of 0.02 and a length of 0.5, smoothed by a radius: how far it
/// reaches is how much of them is left.
double height_after(double radius) {
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> place(-1.0, 1.0);
  std::vector<dvec3> points;
  for (int i = 0; i < 60000; ++i) {
    const double x = place(random), y = place(random);
    points.emplace_back(x, y, 0.02 * std::sin(4.0 * std::numbers::pi * x));
  }
  BuildParams params;
  params.smooth_world = radius;
  BuildStats stats;
  const Scene scene = build_scene(scan_of(points), params, 0, stats);
  double sum = 0.0, count = 0.0;
  for (const uvec4& words : scene.data_pool) {
    const dvec3 p = scene.root.to_world(unpack_splat(words).center);
    if (std::max(std::abs(p.x), std::abs(p.y)) > 0.4) continue;
    sum += p.z * p.z, count += 1.0;
  }
  return std::sqrt(sum / count);
}

TEST(Smoothing, ReachesAsFarAsItsRadiusSays) {
  SPLATRAY_NIGHTLY();
  const double before = height_after(0.0);
  EXPECT_GT(height_after(0.03), 0.97 * before);
  EXPECT_LT(height_after(0.5), 0.5 * before) << "60 000 points: 64 of them are within 0.04";
}

TEST(Smoothing, TheStepOfCoordinatesIsTheFloorOfNoise) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> place(-1.0, 1.0);
  for (const double step : {0.0, 0.1}) {
    std::vector<dvec3> points;  // stairs are flat nearly everywhere
    for (int i = 0; i < 20000; ++i) {
      const double x = place(random), y = place(random);
      points.emplace_back(x, y, step > 0.0 ? step * std::round(0.2 * x / step) : 0.2 * x);
    }
    BuildStats stats;
    (void)build_scene(scan_of(points), {}, 0, stats);
    if (step > 0.0)
      EXPECT_GT(stats.noise, 0.5);
    else
      EXPECT_LT(stats.noise, 0.01);
  }
}

}  // namespace
}  // namespace splatray
