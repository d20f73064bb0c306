// Rays that go deep into closed shapes must be stopped at their surface.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "data/shapes.h"
#include "tests/hard/support/chains.h"
#include "tests/hard/support/clouds.h"

namespace splatray::testing {
namespace {

using glm::dvec3;
using std::numbers::pi;

constexpr std::uint64_t SPLATS = 20000;
/// The shape's core: the same shape of this part of its radius, or its tube's.
constexpr double INNER = 0.98;
constexpr double RING = 0.7;
constexpr double TUBE = 0.3;

/// A closed surface and its core, the part of its inside that no ray may reach.
struct ClosedShape {
  OrientedPoints points;
  double area;
  dvec3 (*core_point)(std::mt19937_64& random);    ///< a random point of the core; rays aim at such
  double (*distance_to_core)(const dvec3& point);  ///< a lower bound of it; <= 0 in the core
};

dvec3 in_ball(std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  return random_unit(random) * (INNER * std::cbrt(unit(random)));
}

double to_ball(const dvec3& point) { return glm::length(point) - INNER; }

double to_torus(const dvec3& point) {
  return std::hypot(std::hypot(point.x, point.z) - RING, point.y) - INNER * TUBE;
}

dvec3 in_torus(std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const double along = 2.0 * pi * unit(random);
  const double around = 2.0 * pi * unit(random);
  const double out = INNER * TUBE * std::sqrt(unit(random));
  const double ring = RING + out * std::cos(around);
  return {ring * std::cos(along), out * std::sin(around), ring * std::sin(along)};
}

ClosedShape ball(bool even) {
  return {sphere({.count = SPLATS, .even = even}, 1.0), 4.0 * pi, in_ball, to_ball};
}

ClosedShape ring(bool even) {
  return {torus({.count = SPLATS, .even = even}, RING, TUBE, -pi, pi), torus_area(RING, TUBE, -pi, pi),
          in_torus, to_torus};
}

std::vector<RayQuery> rays_through(const Scene& scene, const ClosedShape& shape, std::size_t count,
                                   std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<RayQuery> rays;
  rays.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const dvec3 dir = random_unit(random);
    rays.push_back(primary_ray(scene.root.to_root(shape.core_point(random) - 4.0 * dir), dir));
  }
  return rays;
}

/// Whether a ray that is stopped at t reaches the core before (sphere tracing, Hart 1996).
bool reaches_core(const Scene& scene, const ClosedShape& shape, const RayQuery& ray, double t_root) {
  const dvec3 origin = scene.root.to_world(dvec3(ray.origin));
  const dvec3 dir = glm::normalize(dvec3(ray.dir));
  const double t_stop = std::min(t_root * scene.root.unit_world, 4.0);
  double t = 0.0;
  while (t < t_stop) {
    const double distance = shape.distance_to_core(origin + t * dir);
    if (distance < 1e-7) return true;
    t += distance;
  }
  return std::isinf(t_root);
}

/// Rays that reach the shape's core before they hit anything.
CaseRow count_holes(const Scene& scene, const ClosedShape& shape, std::size_t rays,
                    const std::string& compared) {
  DeviceScene device(scene);
  std::uint64_t holes = 0;
  in_batches(rays, [&](std::size_t first, std::size_t count) {
    const Segment segment = traced(device, rays_through(scene, shape, count, first + 1));
    for (std::size_t i = 0; i < count; ++i)
      holes += reaches_core(scene, shape, segment.rays[i], double(segment.hits[i].t_first)) ? 1 : 0;
  });
  CaseRow row = device.row(compared);
  row.count = rays;
  row.exceptions = holes;
  row.remark = "overlap " + short_number(overlap_of(scene, shape.area));
  return row;
}

/// `known`: rays that are known to get through, where the rule of radii leaves holes.
void expect_watertight(const ClosedShape& shape, double overlap_most, const std::string& compared,
                       std::uint64_t known = 0) {
  const Scene scene = scene_of({{shape.points, test_material(MATERIAL_TWO_SIDED)}});
  EXPECT_LE(overlap_of(scene, shape.area), overlap_most);
  conclude_missed(count_holes(scene, shape, hard_rays(),
                              compared + ": rays that get 2 % of the radius below the exact surface"),
                  known);
}

TEST(Watertight, SphereEven) { expect_watertight(ball(true), 2.2, "20 000 even splats"); }
TEST(Watertight, SphereRandom) { expect_watertight(ball(false), 5.0, "20 000 random splats"); }
TEST(Watertight, TorusEven) { expect_watertight(ring(true), 2.2, "20 000 even splats", known_of(3, 26)); }
TEST(Watertight, TorusRandom) { expect_watertight(ring(false), 5.0, "20 000 random splats", known_of(1, 8)); }

TEST(Watertight, AMissingSplatIsNoticed) {
  ClosedShape shape = ball(true);
  shape.points = kept(shape.points, [](const dvec3& position) { return position.y < 0.99; });
  const Scene scene = scene_of({{shape.points, test_material(MATERIAL_TWO_SIDED)}});
  conclude_failing(count_holes(scene, shape, hard_rays() / 20, "sphere without the splats of its pole"));
}

}  // namespace
}  // namespace splatray::testing
