// Directions that make slab tests and octree steps degenerate, and queries that are no rays at all.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "tests/hard/support/clouds.h"
#include "tests/hard/support/device_scene.h"
#include "tests/hard/support/lattice_soup.h"

namespace splatray::testing {
namespace {

using glm::dvec3;

/// The 26 directions to the neighbours of a cube in a grid, each with all choices of sign for its zeros.
std::vector<vec3> grid_directions() {
  constexpr std::array<float, 4> PARTS = {-1.0F, -0.0F, 0.0F, 1.0F};
  std::vector<vec3> directions;
  for (const float x : PARTS)
    for (const float y : PARTS)
      for (const float z : PARTS)
        if (x != 0.0F || y != 0.0F || z != 0.0F) directions.push_back(glm::normalize(vec3(x, y, z)));
  return directions;
}

/// `count` rays a direction, from lattice_points.
std::vector<RayQuery> rays_along(const std::vector<vec3>& directions, std::size_t count) {
  std::vector<RayQuery> rays;
  std::mt19937_64 random(3);
  for (const vec3& direction : directions) {
    for (std::size_t i = 0; i < count; ++i) {
      RayQuery ray = primary_ray(lattice_point(random), dvec3(direction));
      ray.dir = direction;  // with its signs of zero
      rays.push_back(ray);
    }
  }
  return rays;
}

TEST(Direction, AxisParallelAndDiagonal) {
  const Scene scene = lattice_soup();
  DeviceScene device(scene);
  conclude(compare_with_brute_force(device, BruteForce(scene), rays_along(grid_directions(), 500),
                                    "26 directions x signs of zero"));
}

TEST(Direction, NegativeZeroIsZero) {
  const Scene scene = lattice_soup();
  DeviceScene device(scene);
  std::vector<RayQuery> rays = rays_along(grid_directions(), 500);
  const std::vector<RayHit> hits = device.intersect(rays);
  for (RayQuery& ray : rays) ray.dir = ray.dir + vec3(0.0F);  // -0 + 0 = 0
  const std::vector<RayHit> hits_of_positive = device.intersect(rays);
  CaseRow row = device.row("bits of answers, with -0 and with 0");
  row.count = rays.size();
  row.exceptions = different_bits(hits, hits_of_positive);
  conclude(row);
}

TEST(Direction, TinyComponents) {
  const Scene scene = lattice_soup();
  DeviceScene device(scene);
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> exponent(-45.0, 0.0);
  std::vector<RayQuery> rays;
  for (int i = 0; i < 50000; ++i) {
    dvec3 dir = random_unit(random);
    dir[i % 3] = std::copysign(std::pow(10.0, exponent(random)), dir[i % 3]);
    if (i % 2 == 0) dir[(i + 1) % 3] = std::copysign(std::pow(10.0, exponent(random)), dir[(i + 1) % 3]);
    rays.push_back(primary_ray(lattice_point(random), dir));
  }
  conclude(compare_with_brute_force(device, BruteForce(scene), rays, "one or two components of 1e-45 to 1"));
}

/// A number that is no good as a coordinate.
float bad_number(std::mt19937_64& random) {
  constexpr float INF = std::numeric_limits<float>::infinity();
  constexpr std::array<float, 10> BAD = {
      0.0F,  -0.0F,  INF,    -INF,   std::numeric_limits<float>::quiet_NaN(),
      1e30F, -1e30F, 1e-30F, 1e-42F, std::numeric_limits<float>::max()};
  return BAD[random() % BAD.size()];
}

TEST(Direction, QueriesThatAreNoRays) {
  DeviceScene device(lattice_soup());
  std::mt19937_64 random(9);
  std::vector<RayQuery> rays;
  for (std::size_t i = 0; i < hard_rays() / 5; ++i) {
    RayQuery ray = primary_ray(lattice_point(random), random_unit(random));
    const int part = static_cast<int>(random() % 3);
    if (i % 3 == 0) ray.dir[part] = bad_number(random);
    if (i % 3 == 1) ray.origin[part] = bad_number(random);
    if (i % 3 == 2) ray.dir[part] = bad_number(random), ray.t_min = bad_number(random);
    rays.push_back(ray);
  }
  const std::vector<RayHit> hits = device.intersect(rays);
  CaseRow row =
      device.row("NaN, infinity, 1e±30 and denormals in origin, direction, t_min: finite hit or a miss");
  row.count = hits.size();
  row.unit = "queries";
  conclude(row);
}

}  // namespace
}  // namespace splatray::testing
