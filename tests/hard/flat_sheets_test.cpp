// Flat sheets in planes between cells, where a disc is also listed on the side that holds no centre: hits are those of brute
// force, and a ray tests and a splat is listed as little as elsewhere.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/all_tests.h"
#include "tests/hard/support/clouds.h"
#include "tests/hard/support/device_scene.h"
#include "tests/trace/rays.h"

namespace splatray::testing {
namespace {

using glm::dvec3;

constexpr int SHEET_SPLATS = 20000;
constexpr double SHEET_ROOT_EDGE = 1U << LATTICE_BITS;
constexpr std::size_t SHEET_RAYS = 4000;
constexpr double ASIDE = 43000.0;   ///< about a third of the cells in which it matters, and of their halves
constexpr double MOST_TESTS = 3.5;  ///< of a ray, over those of the same discs moved aside
constexpr double MOST_REFERENCES = 2.5;  ///< of a splat, likewise

struct Cost {
  double tests, references;
};

Cost cost_of(const Scene& scene, const std::string& what) {
  DeviceScene device(scene);
  const std::vector<RayQuery> rays = random_primary_rays(scene, SHEET_RAYS, 3);
  CaseRow row = compare_with_brute_force(device, BruteForce(scene), rays, what, Compared::hits);
  const Cost cost{double(device.counter(COUNT_TESTS)) / double(rays.size()),
                  double(scene.reference_pool.size()) / double(scene.data_pool.size())};
  row.remark =
      short_number(cost.tests) + " tests a ray, " + short_number(cost.references) + " references a splat";
  conclude(row);
  return cost;
}

Scene in_lattice(std::vector<Disc> discs, double aside = 0.0) {
  for (Disc& disc : discs) disc.center += aside;
  return lattice_scene(discs, test_material(MATERIAL_TWO_SIDED), 0);
}

/// Exact, and not much dearer than beside the planes between cells.
void expect_cheap(const std::vector<Disc>& discs, const std::string& what) {
  const Cost cost = cost_of(in_lattice(discs), what);
  const Cost beside = cost_of(in_lattice(discs, ASIDE), what + ", moved aside");
  EXPECT_LT(cost.tests, MOST_TESTS * beside.tests) << what;
  EXPECT_LT(cost.references, MOST_REFERENCES * beside.references) << what;
}

/// Discs of a square that is `across` lattice units wide, in the plane where `axis` is `height`, tilted by so much.
std::vector<Disc> square(int count, int axis, double height, double across = 0.9 * SHEET_ROOT_EDGE,
                         double tilt = 0.0) {
  std::mt19937_64 random(static_cast<std::uint64_t>(height) + static_cast<std::uint64_t>(axis));
  std::uniform_real_distribution<double> within(0.5 * (SHEET_ROOT_EDGE - across),
                                                0.5 * (SHEET_ROOT_EDGE + across));
  const double radius = 1.5 * across / std::sqrt(double(count));
  std::vector<Disc> discs;
  for (int i = 0; i < count; ++i) {
    dvec3 center, normal(0.0);
    center[(axis + 1) % 3] = within(random);
    center[(axis + 2) % 3] = within(random);
    center[axis] = height + tilt * (center[(axis + 1) % 3] - 0.5 * SHEET_ROOT_EDGE);
    normal[axis] = 1.0;
    normal[(axis + 1) % 3] = -tilt;
    discs.push_back({glm::round(center), glm::normalize(normal), radius});
  }
  return discs;
}

void append(std::vector<Disc>& discs, const std::vector<Disc>& more) {
  discs.insert(discs.end(), more.begin(), more.end());
}

TEST(FlatSheet, InTheMiddlePlane) {
  for (int axis = 0; axis < 3; ++axis)
    expect_cheap(square(SHEET_SPLATS, axis, 0.5 * SHEET_ROOT_EDGE),
                 "sheet across axis " + std::to_string(axis));
  expect_cheap(square(SHEET_SPLATS, 2, 0.5 * SHEET_ROOT_EDGE, 0.5 * SHEET_ROOT_EDGE), "smaller sheet");
}

TEST(FlatSheet, InEveryPlaneBetweenCells) {
  SPLATRAY_NIGHTLY();
  std::vector<Disc> discs;
  for (int plane = 1; plane < 16; ++plane)
    append(discs, square(SHEET_SPLATS / 15, 2, plane * SHEET_ROOT_EDGE / 16.0));
  expect_cheap(discs, "sheets in 15 planes between cells");
  for (int plane = 1; plane < 16; ++plane)
    append(discs, square(SHEET_SPLATS / 15, 0, plane * SHEET_ROOT_EDGE / 16.0));
  expect_cheap(discs, "sheets in 30 planes between cells");
}

TEST(FlatSheet, TwoOfThem) {
  std::vector<Disc> discs = square(SHEET_SPLATS / 2, 1, 0.5 * SHEET_ROOT_EDGE);
  append(discs, square(SHEET_SPLATS / 2, 1, 0.75 * SHEET_ROOT_EDGE));
  expect_cheap(discs, "two sheets");
}

TEST(FlatSheet, WithASpeckBesideIt) {
  for (const double above : {32.0, 4000.0, 200000.0}) {
    std::vector<Disc> discs = square(SHEET_SPLATS, 2, 0.5 * SHEET_ROOT_EDGE);
    discs.push_back({dvec3(0.3 * SHEET_ROOT_EDGE, 0.3 * SHEET_ROOT_EDGE, 0.5 * SHEET_ROOT_EDGE + above),
                     dvec3(0.0, 0.0, 1.0), 100.0});
    expect_cheap(discs, "sheet and a speck " + short_number(above) + " above");
  }
}

TEST(FlatSheet, HardlyTilted) {
  SPLATRAY_NIGHTLY();
  for (const double tilt : {1e-7, 1e-6, 1e-5, 1e-4, 1e-2})
    expect_cheap(square(SHEET_SPLATS, 2, 0.5 * SHEET_ROOT_EDGE, 0.9 * SHEET_ROOT_EDGE, tilt),
                 "sheet tilted by " + short_number(tilt));
}

TEST(FlatSheet, BesideThePlane) {
  SPLATRAY_NIGHTLY();
  for (const double off : {-5.0, -4.0, 4.0})
    expect_cheap(square(SHEET_SPLATS, 2, 0.5 * SHEET_ROOT_EDGE + off), "sheet " + short_number(off) + " off");
}

/// Their normals are rough: discs of centres on one side reach through.
TEST(FlatSheet, WithRoughNormals) {
  std::vector<Disc> discs = square(SHEET_SPLATS, 2, 0.5 * SHEET_ROOT_EDGE - 8.0);
  std::mt19937_64 random(5);
  for (Disc& disc : discs) disc.normal = glm::normalize(disc.normal + 0.1 * random_unit(random));
  expect_cheap(discs, "sheet with rough normals");
}

TEST(FlatSheet, SixOfACube) {
  std::vector<Disc> discs;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {0.25, 0.75})
      append(discs, square(SHEET_SPLATS / 6, axis, side * SHEET_ROOT_EDGE, 0.5 * SHEET_ROOT_EDGE));
  expect_cheap(discs, "cube whose faces lie between cells");
}

/// Points of a floor with a little noise, whose coordinates are whole multiples of `step`.
std::vector<dvec3> rounded_floor(double step, const dvec3& from = dvec3(0.0)) {
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> within(0.0, 10.0);
  std::normal_distribution<double> noise(0.0, 0.4 * step);
  std::vector<dvec3> points;
  for (int i = 0; i < SHEET_SPLATS; ++i)
    points.push_back(from + step * glm::round(dvec3(within(random), within(random), noise(random)) / step));
  return points;
}

/// Of points as a scanner's: normals and radii are found.
void expect_cheap(const std::vector<dvec3>& points, double most_tests, const std::string& what) {
  InputObject object;
  object.points.position = points;
  object.material = test_material(MATERIAL_TWO_SIDED);
  const Cost cost = cost_of(build({object}), what);
  EXPECT_LT(cost.tests, most_tests) << what;
  EXPECT_LT(cost.references, 6.0) << what;
}

TEST(FlatSheet, RoundedToAGrid) {
  for (const double step : {1e-4, 0.01, 0.1})
    expect_cheap(rounded_floor(step), 65.0, "floor rounded to " + short_number(step));
}

TEST(FlatSheet, AtLargeCoordinates) {
  std::vector<dvec3> points = rounded_floor(0.01, dvec3(500000.0, 4649776.0, 128.0));
  for (dvec3& point : points) point.z = 128.0;
  expect_cheap(points, 32.0, "flat floor in UTM");
}

}  // namespace
}  // namespace splatray::testing
