// Sheets that are near each other, end, meet at edges, or do not know which side is out.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "data/shapes.h"
#include "tests/hard/support/chains.h"
#include "tests/hard/support/clouds.h"

namespace splatray::testing {
namespace {

using glm::dvec3;

/// Hits that are not where and as they should be: `exact(world position, turned normal)` says.
CaseRow count_wrong(const Scene& scene, const std::vector<RayQuery>& rays, const std::string& what,
                    const std::function<bool(const dvec3& at, const dvec3& normal)>& exact) {
  DeviceScene device(scene);
  const std::vector<RayHit> hits = device.intersect(rays);
  CaseRow row = device.row(what);
  row.count = rays.size();
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const bool found = hits[i].object != NO_OBJECT;
    const double t = found ? double(hits[i].t) : 0.0;
    const dvec3 at = scene.root.to_world(dvec3(rays[i].origin) + t * dvec3(rays[i].dir));
    row.exceptions += found && exact(at, dvec3(hits[i].normal)) ? 0 : 1;
  }
  return row;
}

constexpr double WALL_RADIUS = 0.02;  ///< about that of the discs of wall()

/// Two square sheets at y = ±thickness / 2, facing away from each other.
OrientedPoints wall(double thickness) {
  OrientedPoints points = rectangle({.count = 5000}, {-1, 0.5 * thickness, 1}, {2, 0, 0}, {0, 0, -2});
  append(points, rectangle({.count = 5000, .seed = 5}, {-1, -0.5 * thickness, 1}, {0, 0, -2}, {2, 0, 0}));
  return points;
}

std::vector<RayQuery> rays_at_wall(const Scene& scene, double thickness) {
  std::mt19937_64 random(1);
  std::vector<RayQuery> rays;
  for (int i = 0; i < 50000; ++i) {
    dvec3 dir = random_unit(random);
    dir.y = std::copysign(std::abs(dir.y) + 0.05, dir.y);
    const dvec3 target(uniform(random, -0.8, 0.8), std::copysign(0.5 * thickness, -dir.y),
                       uniform(random, -0.8, 0.8));
    rays.push_back(primary_ray(scene.root.to_root(target - 2.0 * dir), dir));
  }
  return rays;
}

TEST(Sheet, ThinWalls) {
  for (const double thickness_r : {0.1, 0.3, 1.0, 3.0}) {
    const double thickness = thickness_r * WALL_RADIUS;
    for (const std::uint32_t flags : {0U, MATERIAL_TWO_SIDED}) {
      const Scene scene = scene_of({{wall(thickness), test_material(flags)}});
      const std::vector<RayQuery> rays = rays_at_wall(scene, thickness);
      std::size_t i = 0;
      conclude(count_wrong(scene, rays,
                           std::string(flags == 0 ? "one" : "two") + "-sided walls " +
                               short_number(thickness_r) + " r apart: the near wall and its normal",
                           [&](const dvec3& at, const dvec3& normal) {
                             const double side = rays[i++].dir.y < 0.0F ? 1.0 : -1.0;
                             return std::abs(at.y - side * 0.5 * thickness) < 1e-4 &&
                                    side * normal.y > 0.9999;
                           }));
    }
  }
}

/// Nothing of a panel's back shows in its front, though its discs are as wide as it is thick, or wider.
TEST(Sheet, ThinPanelsHaveAColourOnEachSide) {
  for (const double thickness_r : {0.1, 0.3, 1.0, 3.0}) {
    const double thickness = thickness_r * WALL_RADIUS;
    const Scene scene =
        scene_of({{painted(wall(thickness), [](dvec3 p) { return dvec3(p.y > 0.0 ? 0.8 : 0.1); }),
                   test_material(MATERIAL_TWO_SIDED)}});
    const std::vector<RayQuery> rays = rays_at_wall(scene, thickness);
    DeviceScene device(scene);
    const std::vector<RayHit> hits = device.intersect(rays);
    CaseRow row = device.row("panels " + short_number(thickness_r) + " r thick: the near side's colour");
    row.count = rays.size();
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const double seen = unpack_color(hits[i].color).x, near = rays[i].dir.y < 0.0F ? 0.8 : 0.1;
      row.exceptions += std::abs(seen - near) > 0.01 ? 1 : 0;
    }
    conclude(row);
  }
}

/// A ray reflected by a mirror wall must not meet its other side, however thin the wall.
TEST(Sheet, ThinMirrorWalls) {
  for (const double thickness_r : {0.1, 0.3, 1.0, 3.0}) {
    const Scene scene = scene_of({{wall(thickness_r * WALL_RADIUS), mirror_material()}});
    DeviceScene device(scene);
    const Segment primary = traced(device, rays_at_wall(scene, thickness_r * WALL_RADIUS));
    std::vector<std::size_t> index = indices(primary.rays.size());
    const Segment mirrored = traced(device, mirrored_rays(primary, index));
    CaseRow row =
        device.row("mirror walls " + short_number(thickness_r) + " r apart: mirrored rays hit nothing");
    row.count = mirrored.rays.size();
    for (const RayHit& hit : mirrored.hits) row.exceptions += hit.object != NO_OBJECT ? 1 : 0;
    conclude(row);
  }
}

/// Orthographic rays at a cube: what is hit outside its silhouette, and what is missed inside.
TEST(Sheet, ConvexEdges) {
  OrientedPoints points;
  for (const SurfacePatch& face : box("cube", dvec3(2.0), false)) append(points, face.make({.count = 3000}));
  const Scene scene = scene_of({{points, test_material(0)}});
  const double radius = median_radius_root(scene) * scene.root.unit_world;
  DeviceScene device(scene);
  std::mt19937_64 random(3);
  std::vector<RayQuery> rays;
  std::vector<double> outside;  // distance from the square that the cube shows
  for (int i = 0; i < 200000; ++i) {
    const dvec3 target(uniform(random, -1.1, 1.1), uniform(random, -1.1, 1.1), 2.0);
    rays.push_back(primary_ray(scene.root.to_root(target), {0.0, 0.0, -1.0}));
    outside.push_back(std::max(std::abs(target.x), std::abs(target.y)) - 1.0);
  }
  const std::vector<RayHit> hits = device.intersect(rays);
  CaseRow row = device.row("cube seen face on: holes inside the silhouette");
  double overhang = 0.0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const bool found = hits[i].object != NO_OBJECT;
    row.count += outside[i] < 0.0 ? 1 : 0;
    row.exceptions += outside[i] < 0.0 && !found ? 1 : 0;
    if (found) overhang = std::max(overhang, outside[i]);
  }
  row.remark = "overhang " + short_number(overhang / radius) + " r";
  conclude(row);
  EXPECT_LT(overhang, 1.5 * radius);
}

TEST(Sheet, ConcaveEdges) {
  OrientedPoints points;
  for (const SurfacePatch& face : box("room", dvec3(2.0), true)) append(points, face.make({.count = 3000}));
  const Scene scene = scene_of({{points, test_material(0)}});
  const double radius = median_radius_root(scene) * scene.root.unit_world;
  std::mt19937_64 random(5);
  std::vector<RayQuery> rays;
  while (rays.size() < 200000) {
    const dvec3 origin(uniform(random, -0.9, 0.9), uniform(random, -0.9, 0.9), uniform(random, -0.9, 0.9));
    rays.push_back(primary_ray(scene.root.to_root(origin), random_unit(random)));
  }
  CaseRow row = count_wrong(scene, rays, "room seen from inside: a wall within 0.01 r, and its normal",
                            [&](const dvec3& at, const dvec3& normal) {
                              for (int axis = 0; axis < 3; ++axis) {
                                const bool on_wall = std::abs(std::abs(at[axis]) - 1.0) < 0.01 * radius;
                                if (on_wall && -normal[axis] * std::copysign(1.0, at[axis]) > 0.9999)
                                  return true;
                              }
                              return false;
                            });
  conclude(row);
}

/// Point of a Moebius strip of width 0.4 about the unit circle, and its normal; u, v in [0, 1).
void moebius(double u, double v, dvec3& position, dvec3& normal) {
  const double angle = 2.0 * M_PI * u;
  const dvec3 radial(std::cos(angle), 0.0, std::sin(angle));
  const dvec3 across = std::cos(0.5 * angle) * radial + std::sin(0.5 * angle) * dvec3(0.0, 1.0, 0.0);
  position = radial + 0.4 * (v - 0.5) * across;
  const dvec3 twist = 0.5 * (std::cos(0.5 * angle) * dvec3(0.0, 1.0, 0.0) - std::sin(0.5 * angle) * radial);
  const dvec3 turn = std::cos(0.5 * angle) * dvec3(-std::sin(angle), 0.0, std::cos(angle));
  const dvec3 along = dvec3(-std::sin(angle), 0.0, std::cos(angle)) + 0.4 * (v - 0.5) * (twist + turn);
  normal = glm::normalize(glm::cross(along, across));
}

TEST(Sheet, MoebiusStrip) {
  OrientedPoints points;
  for (const glm::dvec2& uv : unit_square({.count = 20000})) {
    dvec3 position, normal;
    moebius(uv.x, uv.y, position, normal);
    points.position.push_back(position);
    points.normal.push_back(normal);
  }
  const Scene scene = scene_of({{points, test_material(MATERIAL_TWO_SIDED)}});
  std::mt19937_64 random(7);
  std::vector<RayQuery> rays;
  std::vector<dvec3> normals;
  while (rays.size() < 100000) {
    dvec3 target, normal;
    moebius(uniform(random, 0.0, 1.0), uniform(random, 0.05, 0.95), target, normal);
    const dvec3 dir = random_unit(random);
    if (std::abs(glm::dot(dir, normal)) < 0.2) continue;
    rays.push_back(primary_ray(scene.root.to_root(target - 0.1 * dir), dir));  // too near for another turn
    normals.push_back(glm::dot(dir, normal) > 0.0 ? -normal : normal);
  }
  std::size_t i = 0;
  conclude(count_wrong(scene, rays,
                       "two-sided Moebius strip: hit, and normal against the ray within 5 degrees",
                       [&](const dvec3&, const dvec3& normal) {
                         return glm::dot(normal, normals[i++]) > std::cos(glm::radians(5.0));
                       }));
}

/// Rays at a sphere from both sides: the normal must be the exact one, turned to the ray, within 5 degrees.
CaseRow sphere_from_both_sides(const OrientedPoints& points, const std::string& what) {
  const Scene scene = scene_of({{points, test_material(MATERIAL_TWO_SIDED)}});
  std::mt19937_64 random(9);
  std::vector<RayQuery> rays;
  while (rays.size() < 100000) {
    dvec3 target = random_unit(random);
    if (target.y > -0.05) continue;  // the half that half spheres have
    const dvec3 dir = random_unit(random);
    if (std::abs(glm::dot(dir, target)) < 0.2) continue;
    rays.push_back(primary_ray(scene.root.to_root(target - 0.1 * dir), dir));
  }
  std::size_t i = 0;
  return count_wrong(scene, rays, what, [&](const dvec3& at, const dvec3& normal) {
    const dvec3 outwards = glm::normalize(at);
    const dvec3 expected = glm::dot(dvec3(rays[i++].dir), outwards) > 0.0 ? -outwards : outwards;
    return glm::dot(expected, normal) > std::cos(glm::radians(5.0));
  });
}

TEST(Sheet, OpenHalfSphere) {
  const OrientedPoints half = kept(sphere({.count = 20000}, 1.0), [](const dvec3& at) { return at.y < 0.0; });
  conclude(sphere_from_both_sides(half, "two-sided half sphere: normal to the ray within 5 degrees"));
}

TEST(Sheet, OnePercentFlippedNormals) {
  OrientedPoints points = sphere({.count = 20000}, 1.0);
  for (std::size_t i = 0; i < points.normal.size(); i += 100) points.normal[i] = -points.normal[i];
  conclude(sphere_from_both_sides(points, "two-sided sphere, 1 % of the normals flipped: the same"));
}

}  // namespace
}  // namespace splatray::testing
