/// Flat quads, from squares to long labels, sampled at any density: no hole is left, and discs overlap no more than elsewhere.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <random>

#include "preprocess/build.h"
#include "preprocess/mesh/sample_mesh.h"
#include "tests/all_tests.h"
#include "tests/preprocess/discs.h"
#include "tests/preprocess/sampled_scene.h"

namespace splatray {
namespace {

using glm::dvec3;

/// A rectangle of area 1 and this length over width, about the origin in z = 0, its long side along x.
Mesh quad(double aspect) {
  const double x = 0.5 * std::sqrt(aspect), y = 0.5 / std::sqrt(aspect);
  Mesh mesh;
  mesh.vertices.position = {{-x, -y, 0.0}, {x, -y, 0.0}, {x, y, 0.0}, {-x, y, 0.0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

/// Of `rays` along z to random places of the quad, those that meet no disc.
std::size_t holes(const Scene& scene, double aspect, int rays) {
  const test::FlatDiscs discs(scene);
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit(-0.5, 0.5);
  std::size_t missed = 0;
  for (int i = 0; i < rays; ++i)
    missed += discs.cover({unit(random) * std::sqrt(aspect), unit(random) / std::sqrt(aspect), 0.0}) ? 0 : 1;
  return missed;
}

/// Discs' area over the quad's, without what clip lines take away.
double overlap(const Scene& scene) {
  double area = 0.0;
  for (const uvec4& words : scene.data_pool) area += M_PI * unpack_splat(words).radius_squared;
  return area * scene.root.unit_world * scene.root.unit_world;
}

TEST(FlatQuads, HaveNoHolesWhateverTheirLengthAndDensity) {
  SPLATRAY_NIGHTLY();
  // 1:60 with this number of points had holes where the lattice was slanted.
  for (const auto& [aspect, points] :
       {std::pair(1.0, 300), std::pair(1.0, 10000), std::pair(2.0, 3000), std::pair(5.0, 1000),
        std::pair(10.0, 30), std::pair(14.0, 10000), std::pair(38.1842, 33), std::pair(60.0026, 48345),
        std::pair(100.0, 300), std::pair(100.0, 30000)}) {
    const Scene scene = test::sampled_scene(quad(aspect), std::uint64_t(points));
    EXPECT_EQ(holes(scene, aspect, 1000000), 0U) << "1:" << aspect << ", " << points << " points";
  }
}

/// Processor time of sampling a quad, seconds.
double sampling_seconds(const Mesh& mesh, std::uint64_t points) {
  const auto begin = std::clock();
  const Points sampled =
      sample_surface(mesh, weld_positions(mesh.vertices.position), points, 1, {.clip = true});
  EXPECT_GE(sampled.size(), points);
  return double(std::clock() - begin) / CLOCKS_PER_SEC;
}

/// A thousand times as long an edge has thirty times as many places to look at, and as little to look at from each.
TEST(FlatQuads, ThatAreNeedlesTakeNoLonger) {
  constexpr double LONGER =
      40.0;  // for these places; looking at all samples from each of them took over 150 times as long
  const double square = sampling_seconds(quad(1.0), 100000);
  for (const double aspect : {2e4, 1e6})
    EXPECT_LT(sampling_seconds(quad(aspect), 100000), LONGER * square) << aspect;
  Mesh subnormal = quad(6e4);
  for (dvec3& place : subnormal.vertices.position) place *= 1e-41;
  EXPECT_LT(sampling_seconds(subnormal, 100000), LONGER * square);
}

TEST(FlatQuads, ThatAreLongHaveDiscsAsSmallAsASquares) {
  const double square = overlap(test::sampled_scene(quad(1.0), 10000));
  for (const double aspect : {4.0, 5.0, 10.0, 20.0, 50.0})
    EXPECT_LT(overlap(test::sampled_scene(quad(aspect), 10000)), square) << "1:" << aspect;
}

}  // namespace
}  // namespace splatray
