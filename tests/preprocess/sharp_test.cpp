/// Creases and borders among points alone: found where they are, and nowhere else.
#include "preprocess/surface/sharp.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "preprocess/build.h"
#include "preprocess/scan/noise.h"
#include "preprocess/scan/survey.h"
#include "tests/preprocess/discs.h"
#include "tests/preprocess/shapes.h"

namespace splatray {
namespace {

using glm::dvec3;

constexpr int SIDE = 24;  // points along an edge of the cube
constexpr double SPACING = 1.0 / (SIDE - 1);

/// The corners of a grid on the faces of the unit cube, each once, moved by up to `noise` spacings.
InputObject cube_points(double noise) {
  InputObject object;
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal(0.0, noise * SPACING + 1e-30);
  for (int x = 0; x < SIDE; ++x)
    for (int y = 0; y < SIDE; ++y)
      for (int z = 0; z < SIDE; ++z) {
        const auto last = [](int i) { return i == 0 || i == SIDE - 1; };
        if (!last(x) && !last(y) && !last(z)) continue;
        const dvec3 moved(normal(random), normal(random), normal(random));
        object.points.position.push_back(SPACING * dvec3(x, y, z) + moved);
      }
  object.name = "cube";
  object.material = default_material();
  return object;
}

struct Built {
  Scene scene;
  BuildStats stats;
};

Built built(InputObject object, const BuildParams& params = {}) {
  Built result;
  result.scene = build_scene(test::input_of(std::move(object)), params, 1, result.stats);
  return result;
}

double outside_cube(const dvec3& place) {
  const dvec3 beyond = glm::max(glm::abs(place - 0.5) - 0.5, 0.0);
  return glm::length(beyond);
}

/// The share of places on the cube's faces that no disc of the face covers.
double uncovered(const Scene& scene) {
  const test::Discs discs(scene);
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(0.002, 0.998);
  constexpr int PLACES = 400;
  int open = 0;
  for (int i = 0; i < PLACES; ++i) {
    const int axis = i % 3;
    dvec3 place(unit(random), unit(random), unit(random)), normal(0.0);
    place[axis] = i / 3 % 2;
    normal[axis] = 1.0;
    open += discs.cover(place, normal) ? 0 : 1;
  }
  return double(open) / PLACES;
}

TEST(Sharp, DiscsOfACubesPointsEndAtItsEdges) {
  const Built sharp = built(cube_points(0.0)), blunt = built(cube_points(0.0), {.clip = false});
  const auto edge_points = std::uint64_t{12} * (SIDE - 2) + 8;
  EXPECT_GE(sharp.stats.creased, edge_points * 9 / 10);
  EXPECT_GE(sharp.stats.crease_copies, edge_points * 9 / 10) << "a point on an edge lies on two planes";
  EXPECT_EQ(uncovered(sharp.scene), 0.0);
  const double overhang = test::Discs(sharp.scene).overhang(outside_cube);
  EXPECT_LT(overhang, 0.1);
  EXPECT_GT(test::Discs(blunt.scene).overhang(outside_cube), 3.0 * overhang)
      << "or there was nothing to find";
  EXPECT_EQ(blunt.stats.creased + blunt.stats.bordered, 0U);
  EXPECT_TRUE(blunt.scene.clip_pool.empty());
}

TEST(Sharp, NormalsBesideEdgesAreThoseOfThePlanes) {
  const Built sharp = built(cube_points(0.0));
  for (const uvec4& words : sharp.scene.data_pool) {
    const dvec3 normal = glm::abs(unpack_splat(words).normal);
    EXPECT_GT(std::max({normal.x, normal.y, normal.z}), 0.999);
  }
}

TEST(Sharp, NoiseAndSmoothShapesHaveNone) {
  const Built noisy = built(cube_points(0.3));
  EXPECT_EQ(noisy.stats.creased + noisy.stats.bordered, 0U);
  for (InputObject object : {test::even_sphere(4000), test::random_sphere(4000, 5)}) {
    object.points.normal.clear();
    object.surface_area = 0.0;
    object.oriented = false;
    const Built smooth = built(std::move(object));
    EXPECT_EQ(smooth.stats.creased + smooth.stats.bordered, 0U);
    EXPECT_TRUE(smooth.scene.clip_pool.empty());
  }
}

SharpSides sharp_sides(InputObject object) {
  BuildStats stats;
  Cloud cloud = make_cloud(std::move(object.points), false, true, stats);
  const Stage stage{"normals", {}};
  const Survey survey = survey_points(cloud, {0, 0, 1}, stage);
  return find_sharp(cloud, *survey.near, BuildParams{}.crease_degrees, survey.estimated, stage);
}

TEST(Sharp, MostPointsAreNotLookedAt) {
  constexpr std::size_t BALL = 2000;  // so few that its normals differ beside each other
  InputObject both = cube_points(0.0);
  const std::size_t cube_size = both.points.position.size();
  for (const dvec3& place : test::even_sphere(BALL).points.position)
    both.points.position.push_back(place + dvec3(5.0, 0.0, 0.0));
  const SharpSides cube = sharp_sides(cube_points(0.0)), all = sharp_sides(std::move(both));
  EXPECT_LT(cube.looked_at, cube_size * 2 / 3) << "those that are far from edges";
  EXPECT_LT(all.looked_at, cube.looked_at + BALL * 2 / 3) << "of what bends without a crease";
  EXPECT_GE(all.sides.size(), cube.sides.size()) << "a crease is followed from any of its points";
}

TEST(Sharp, NothingDependsOnTheOrderOfPoints) {
  const Built one = built(cube_points(0.0)), other = built(test::shuffled(cube_points(0.0), 9));
  EXPECT_EQ(one.scene.data_pool, other.scene.data_pool);
  EXPECT_EQ(one.scene.clip_pool, other.scene.clip_pool);
}

/// A lattice in the plane z = 0 that is folded upwards by 45 degrees at x = 0 where `folded`.
InputObject sheet_object(bool folded) {
  InputObject object;
  for (int x = -12; x <= 12; ++x)
    for (int y = 0; y <= 24; ++y) {
      const double height = folded && x > 0 ? x * std::sqrt(0.5) : 0.0;
      object.points.position.emplace_back(folded && x > 0 ? height : x, y, height);
    }
  object.name = "sheet";
  object.material = default_material();
  return object;
}

/// Beyond the flat half's long borders, away from corners and from where the fold ends.
double beside_sheet(const dvec3& place) {
  return place.x > -9.0 && place.x < -6.0 ? std::max({-place.y, place.y - 24.0, 0.0}) : 0.0;
}

TEST(Sharp, AFoldAndBordersAreFound) {
  const Built found = built(sheet_object(true)), blunt = built(sheet_object(true), {.clip = false});
  EXPECT_GT(found.stats.creased, 20U);
  EXPECT_GT(found.stats.bordered, 60U);
  EXPECT_LT(found.stats.bordered, 110U) << "of 98 at the border";
  EXPECT_LT(test::Discs(found.scene).overhang(beside_sheet), 0.1);
  EXPECT_GT(test::Discs(blunt.scene).overhang(beside_sheet), 0.3) << "or there was nothing to find";
}

TEST(Sharp, NothingEndsWhereSamplingIsDenser) {
  InputObject denser = sheet_object(false);
  for (int x = -24; x < 0; ++x)
    for (int y = 0; y < 48; ++y) denser.points.position.emplace_back(0.5 * x - 0.25, 0.5 * y + 0.25, 0.0);
  const Built found = built(std::move(denser));
  EXPECT_GT(found.stats.bordered, 30U);
  for (std::size_t i = 0; i < found.scene.clip_pool.size(); ++i) {
    const dvec3 place = found.scene.root.to_world(unpack_splat(found.scene.data_pool[i]).center);
    const bool inner = place.x > -10.0 && place.x < 10.0 && place.y > 2.0 && place.y < 22.0;
    EXPECT_FALSE(inner && found.scene.clip_pool[i] != CLIP_NONE) << place.x << ' ' << place.y;
  }
}

TEST(Sharp, GivenNormalsStay) {
  InputObject object = cube_points(0.0);
  for (const dvec3& place : object.points.position) {
    const dvec3 from = glm::abs(place - 0.5);
    object.points.normal.emplace_back(from.x >= from.y && from.x >= from.z ? glm::vec3(place.x - 0.5, 0, 0)
                                      : from.y >= from.z                   ? glm::vec3(0, place.y - 0.5, 0)
                                                                           : glm::vec3(0, 0, place.z - 0.5));
  }
  const Built found = built(std::move(object));
  EXPECT_GT(found.stats.creased, 200U);
  EXPECT_EQ(found.stats.crease_copies, 0U);
  EXPECT_EQ(found.scene.data_pool.size(), found.stats.points_read);
}

TEST(Sharp, GivenNormalsThatWereInterpolatedHideNoCrease) {
  InputObject cube = cube_points(0.0);
  for (const dvec3& place :
       cube.points.position) {  // within three spacings of an edge they turn to the other face's
    const dvec3 share = glm::max(glm::abs(place - 0.5) - 0.5 + 3.0 * SPACING, 0.0);
    cube.points.normal.emplace_back(glm::normalize(share * glm::sign(place - 0.5)));
  }
  const Built sharp = built(cube), blunt = built(cube, {.clip = false});
  const auto edge_points = std::uint64_t{12} * (SIDE - 2) + 8;
  EXPECT_GE(sharp.stats.creased, edge_points * 9 / 10);
  EXPECT_EQ(uncovered(sharp.scene), 0.0);
  EXPECT_LT(test::Discs(sharp.scene).overhang(outside_cube), 0.45)
      << "discs on flat faces lean as they were given";
  EXPECT_GT(test::Discs(blunt.scene).overhang(outside_cube), 0.6) << "or there was nothing to find";
}

TEST(Sharp, AnObjectOfWhichNoPointIsLeftIsPassedOver) {
  Input input = test::input_of(cube_points(0.0));
  input.objects.push_back(cube_points(0.0));
  for (dvec3& place : input.objects.back().points.position) place = dvec3(NAN);
  BuildStats stats;
  const std::size_t count = input.objects.front().points.size();
  input.objects.back().points.columns = {{"height", std::vector<float>(count)}};
  const Scene scene = build_scene(std::move(input), {}, 1, stats);
  EXPECT_GE(scene.data_pool.size(), count);
  for (const Column& column : scene.columns) EXPECT_EQ(column.size(), scene.data_pool.size()) << column.name;
}

TEST(Sharp, PositionsThatAreGoneSayNothingOfTheirSteps) {
  Cloud cloud;
  cloud.coord = {glm::vec3(0.0F), glm::vec3(0.5F)};
  EXPECT_EQ(coordinate_step(cloud), glm::vec3(0.0F));
}

TEST(Sharp, BordersOfABentSheetAreFound) {
  InputObject bent;
  for (int x = -12; x <= 12; ++x)
    for (int y = 0; y <= 24; ++y) {
      const double angle = x / 12.0;
      const dvec3 out(std::sin(angle), 0.0, std::cos(angle));
      bent.points.position.push_back(12.0 * out + dvec3(0.0, y, 0.0));
      bent.points.normal.emplace_back(out);
    }
  bent.name = "bent sheet";
  bent.material = default_material();
  const Built found = built(std::move(bent));
  EXPECT_GT(found.stats.bordered, 80U) << "of 96 at the border";
  EXPECT_LT(test::Discs(found.scene).overhang([](const dvec3& place) {
    return std::max({-place.y, place.y - 24.0, 0.0});
  }),
            0.1);
}

}  // namespace
}  // namespace splatray
