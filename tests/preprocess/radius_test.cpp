/// Radius rules against values worked out by hand, and watertightness of what they give.
#include "preprocess/surface/radius.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "preprocess/surface/voronoi.h"
#include "tests/preprocess/shapes.h"

namespace splatray {
namespace {

/// Radii of an object in world units, in canonical order.
std::vector<double> radii_world(const InputObject& object, RadiusRule rule, Cloud* cloud_out = nullptr) {
  Cloud cloud = test::cloud_of(object);
  find_radii(cloud, rule, 1.0, false, {"radii", test::SILENT});
  std::vector<double> radii;
  for (const float radius : cloud.radius) radii.push_back(radius * cloud.half_extent_world);
  if (cloud_out != nullptr) *cloud_out = std::move(cloud);
  return radii;
}

/// Rays from the centre of the unit sphere that meet no disc, per million.
double holes_ppm(const InputObject& sphere, RadiusRule rule) {
  Cloud cloud;
  const std::vector<double> radius = radii_world(sphere, rule, &cloud);
  const double reach = 2.0 * *std::max_element(radius.begin(), radius.end());
  std::mt19937_64 random(9);
  std::normal_distribution<double> gauss;
  constexpr int RAYS = 20000;
  int holes = 0;
  for (int ray = 0; ray < RAYS; ++ray) {
    const glm::dvec3 dir = glm::normalize(glm::dvec3(gauss(random), gauss(random), gauss(random)));
    bool hit = false;
    for (std::size_t i = 0; i < cloud.size() && !hit; ++i) {
      const glm::dvec3& center = cloud.position[i];
      if (glm::length(center - dir) > reach) continue;
      const glm::dvec3 normal(cloud.normal[i]);
      const double t = glm::dot(normal, center) / glm::dot(normal, dir);
      hit = glm::length(t * dir - center) <= radius[i];
    }
    holes += hit ? 0 : 1;
  }
  return 1e6 * holes / RAYS;
}

double area_ratio(const InputObject& sphere, RadiusRule rule) {
  double sum = 0.0;
  for (const double radius : radii_world(sphere, rule)) sum += radius * radius;
  return sum / 4.0;
}

TEST(Radius, CoverageOfASquareLatticeIsHalfTheDiagonal) {
  Cloud cloud;
  const std::vector<double> radii = radii_world(test::square_lattice(21, 2.0), RadiusRule::coverage, &cloud);
  for (std::size_t i = 0; i < radii.size(); ++i) {
    const glm::dvec3 from_border = glm::min(cloud.position[i], 40.0 - cloud.position[i]);
    if (std::min(from_border.x, from_border.y) > 1.0) {
      EXPECT_NEAR(radii[i], 1.02 * std::sqrt(2.0), 1e-5);
    } else {
      EXPECT_GE(radii[i], 1.02 * std::sqrt(2.0) - 1e-5);
      EXPECT_LE(radii[i], 1.02 * std::sqrt(2.0) * 1.2)
          << "a border point must not reach far beyond the surface";
    }
  }
}

TEST(Radius, KnnOfASquareLatticeIsTheSixthDistance) {
  Cloud cloud;
  const std::vector<double> radii = radii_world(test::square_lattice(21, 2.0), RadiusRule::knn, &cloud);
  for (std::size_t i = 0; i < radii.size(); ++i) {
    const glm::dvec3 from_border = glm::min(cloud.position[i], 40.0 - cloud.position[i]);
    if (std::min(from_border.x, from_border.y) < 1.0) continue;
    EXPECT_NEAR(radii[i], 0.65 * 2.0 * std::sqrt(2.0), 1e-5);
  }
}

TEST(Radius, CoverageClosesEvenAndRandomSpheres) {
  EXPECT_EQ(holes_ppm(test::even_sphere(4000), RadiusRule::coverage), 0.0);
  EXPECT_LE(area_ratio(test::even_sphere(4000), RadiusRule::coverage), 2.2);
  EXPECT_EQ(holes_ppm(test::random_sphere(4000, 1), RadiusRule::coverage), 0.0);
  EXPECT_LE(area_ratio(test::random_sphere(4000, 1), RadiusRule::coverage), 5.0);
}

TEST(Radius, KnnClosesEvenSpheresOnly) {
  EXPECT_EQ(holes_ppm(test::even_sphere(4000), RadiusRule::knn), 0.0);
  EXPECT_GT(holes_ppm(test::random_sphere(4000, 1), RadiusRule::knn), 1000.0);
}

TEST(Radius, OtherSheetsDoNotCutTheCell) {
  InputObject sheets = test::square_lattice(15, 1.0);
  const std::size_t count = sheets.points.size();
  for (std::size_t i = 0; i < count; ++i) {
    sheets.points.position.push_back(sheets.points.position[i] + glm::dvec3(0.45, 0.45, 0.1));
    sheets.points.normal.emplace_back(0.0F, 0.0F, -1.0F);
  }
  sheets.oriented = true;
  const std::vector<double> radii = radii_world(sheets, RadiusRule::coverage);
  EXPECT_GE(*std::min_element(radii.begin(), radii.end()), 1.02 * std::sqrt(0.5) - 1e-5);
}

TEST(Radius, DuplicatesDoNotShrinkDiscs) {
  InputObject twice = test::square_lattice(11, 1.0);
  const Points once = twice.points;
  twice.points.position.insert(twice.points.position.end(), once.position.begin(), once.position.end());
  twice.points.normal.insert(twice.points.normal.end(), once.normal.begin(), once.normal.end());
  for (const RadiusRule rule : {RadiusRule::coverage, RadiusRule::knn}) {
    const std::vector<double> single = radii_world(test::square_lattice(11, 1.0), rule);
    const std::vector<double> both = radii_world(twice, rule);
    for (std::size_t i = 0; i < both.size(); ++i) EXPECT_EQ(both[i], single[i / 2]);
  }
}

TEST(Radius, GivenRadiiAreHonouredAndBadOnesComputed) {
  InputObject lattice = test::square_lattice(11, 1.0);
  lattice.points.radius.assign(121, 0.3F);
  lattice.points.radius[5] = 0.0F;
  lattice.points.radius[60] = -1.0F;
  lattice.points.radius[61] = std::numeric_limits<float>::quiet_NaN();
  BuildStats stats;
  Cloud cloud = make_cloud(std::move(lattice.points), false, false, stats);
  EXPECT_EQ(stats.radii_given, 118U);
  EXPECT_EQ(stats.radii_repaired, 3U);
  find_radii(cloud, RadiusRule::coverage, 2.0, false, {"radii", test::SILENT});
  int given = 0;
  for (const float radius : cloud.radius) {
    EXPECT_GT(radius, 0.0F);
    given += std::abs(radius * cloud.half_extent_world - 0.6) < 1e-6 ? 1 : 0;
  }
  EXPECT_EQ(given, 118);
}

TEST(Radius, StrayPointStaysSmall) {
  InputObject object = test::square_lattice(30, 1.0);
  object.points.position.emplace_back(15.0, 15.0, 500.0);
  object.points.normal.emplace_back(0.0F, 0.0F, 1.0F);
  for (const RadiusRule rule : {RadiusRule::coverage, RadiusRule::knn}) {
    const std::vector<double> radii = radii_world(object, rule);
    EXPECT_LT(*std::max_element(radii.begin(), radii.end()), 6.0);
  }
}

TEST(Radius, LonePointHasNone) {
  InputObject object;
  object.points.position.assign(5, glm::dvec3(1.0, 2.0, 3.0));
  object.points.normal.assign(5, glm::vec3(0.0F, 0.0F, 1.0F));
  for (const double radius : radii_world(object, RadiusRule::coverage)) EXPECT_EQ(radius, 0.0);
}

/// Two sheets that all but touch: creases through the point in all directions.
TEST(Radius, CreasesThatHardlyMissThePointLeaveACell) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> angle(0.0, 2.0 * std::numbers::pi), exponent(-320.0, -10.0);
  const std::vector<TangentNeighbour> neighbours{{{1.0, 0.0}, 1.0}, {{0.0, 1.0}, 1.0}, {{-1.0, 0.0}, 1.0}};
  for (int round = 0; round < 2000; ++round) {
    std::vector<TangentCrease> creases;
    for (int i = 0; i < 24; ++i) {
      const double turn = i % 2 == 0 ? angle(random) : std::numbers::pi + angle(random) * 1e-17;
      creases.push_back({{std::cos(turn), std::sin(turn)}, std::pow(10.0, exponent(random))});
    }
    const VoronoiReach reach = voronoi_reach(neighbours, creases);
    EXPECT_FALSE(reach.radius < 0.0) << round;
  }
}

TEST(Voronoi, HexagonReachesItsCorners) {
  std::vector<TangentNeighbour> ring;
  for (int i = 0; i < 6; ++i) {
    const double angle = i * std::acos(0.5);
    ring.push_back({2.0 * glm::dvec2(std::cos(angle), std::sin(angle)), 2.0});
  }
  const VoronoiReach reach = voronoi_reach(ring, {});
  EXPECT_NEAR(reach.radius, 2.0 / std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(reach.decisive_distance, 4.0 / std::sqrt(3.0), 1e-12);
}

TEST(Voronoi, CellEndsAtACrease) {
  const std::vector<TangentNeighbour> lattice{{{-1.0, 0.0}, 1.0}, {{0.0, 1.0}, 1.0}, {{0.0, -1.0}, 1.0}};
  const std::vector<TangentCrease> crease{{{1.0, 0.0}, 0.25}};
  EXPECT_NEAR(voronoi_reach(lattice, crease).radius, std::sqrt(0.5), 1e-12);
  const std::vector<TangentNeighbour> wide{{{-0.5, 0.0}, 0.5}, {{0.0, 1.0}, 1.0}, {{0.0, -1.0}, 1.0}};
  EXPECT_NEAR(voronoi_reach(wide, crease).radius, std::hypot(0.25, 0.5), 1e-12);
}

TEST(Voronoi, NeighboursInLineAlongABorderDoNotReachOut) {
  const std::vector<TangentNeighbour> border{{{1.0, 0.05}, std::hypot(1.0, 0.05)},
                                             {{-1.0, 0.05}, std::hypot(1.0, 0.05)},
                                             {{0.0, -1.1}, 1.1},
                                             {{1.0, -1.0}, std::sqrt(2.0)},
                                             {{-1.0, -1.0}, std::sqrt(2.0)}};
  EXPECT_LE(voronoi_reach(border, {}).radius, 0.8 * std::sqrt(2.0) + 1e-12);
}

TEST(Voronoi, OpenCellEndsNearItsNeighbours) {
  const std::vector<TangentNeighbour> one_side{{{-1.0, 0.0}, 1.0}};
  EXPECT_NEAR(voronoi_reach(one_side, {}).radius, 0.65, 1e-12);
  EXPECT_EQ(voronoi_reach({}, {}).radius, 0.0);
}

/// Three points far beyond the last row of a lattice: twice its 6th distance is the most that is usual around them.
TEST(Radius, NoDiscOfMeasuredPointsSpansAHole) {
  InputObject object = test::square_lattice(21, 1.0);
  for (int i = 0; i < 3; ++i) {
    object.points.position.emplace_back(4.0 * i + 6.0, 30.0, 0.0);
    object.points.normal.emplace_back(0.0F, 0.0F, 1.0F);
  }
  for (const bool measured : {true, false}) {
    Cloud cloud = test::cloud_of(object);
    cloud.measured = measured;
    find_radii(cloud, RadiusRule::coverage, 1.0, false, {"radii", test::SILENT});
    double widest = 0.0;
    for (const float radius : cloud.radius) widest = std::max(widest, radius * cloud.half_extent_world);
    if (measured)
      EXPECT_LT(widest, 0.65 * 2.0 * 2.0 + 0.01);
    else
      EXPECT_GT(widest, 2.8);
  }
}

}  // namespace
}  // namespace splatray
