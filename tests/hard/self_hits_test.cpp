// Secondary rays must not hit the sheet they leave, and must hit what the exact shape says, on smooth mirrors
// and glass.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "data/shapes.h"
#include "tests/hard/support/chains.h"
#include "tests/hard/support/clouds.h"

namespace splatray::testing {
namespace {

using glm::dvec3;

constexpr std::uint64_t SELF_HIT_SPLATS = 20000;
constexpr double MOST_OFF_CENTRE = 0.9;  ///< rays at spheres pass their centre at most this far, in radii

/// A ray given in world space.
RayQuery world_ray(const Scene& scene, const dvec3& origin, const dvec3& dir) {
  return primary_ray(scene.root.to_root(origin), dir);
}

/// A ray at the sphere of radius 1 about the origin.
RayQuery ray_at_sphere(const Scene& scene, std::mt19937_64& random) {
  const dvec3 dir = random_unit(random);
  const dvec3 inner = random_unit(random) * (MOST_OFF_CENTRE * std::cbrt(uniform(random, 0.0, 1.0)));
  return world_ray(scene, inner - 4.0 * dir, dir);
}

/// Where the ray leaves the sphere of radius 1 about the world's origin, in units of the ray, root space.
double exit_of_sphere(const Scene& scene, const RayQuery& ray) {
  const dvec3 origin = scene.root.to_world(dvec3(ray.origin));
  const dvec3 dir(ray.dir);
  const double along = glm::dot(origin, dir) / glm::dot(dir, dir);
  const double left = along * along - (glm::dot(origin, origin) - 1.0) / glm::dot(dir, dir);
  return (-along + std::sqrt(std::max(left, 0.0))) / scene.root.unit_world;
}

using MakeRay = RayQuery (*)(const Scene& scene, std::mt19937_64& random);

std::vector<RayQuery> made_rays(const Scene& scene, std::size_t first, std::size_t count, MakeRay make) {
  std::mt19937_64 random(first + 1);
  std::vector<RayQuery> rays;
  rays.reserve(count);
  for (std::size_t i = 0; i < count; ++i) rays.push_back(make(scene, random));
  return rays;
}

std::uint64_t count_found(const Segment& segment) {
  std::uint64_t found = 0;
  for (const RayHit& hit : segment.hits) found += hit.object != NO_OBJECT ? 1 : 0;
  return found;
}

/// `rays` mirrored rays of a convex mirror seen from outside, or of a plane: they must hit nothing.
CaseRow mirrored_away(const Scene& scene, MakeRay make, std::size_t rays, const std::string& compared,
                      const Settings& settings = {}) {
  DeviceScene device(scene);
  std::uint64_t self_hits = 0;
  std::uint64_t secondary = 0;
  in_batches(rays, [&](std::size_t first, std::size_t count) {
    std::vector<std::size_t> index = indices(count);
    const Segment primary = traced(device, made_rays(scene, first, count, make), settings);
    const Segment mirrored = traced(device, mirrored_rays(primary, index), settings);
    secondary += mirrored.rays.size();
    self_hits += count_found(mirrored);
  });
  CaseRow row = device.row(compared);
  row.count = secondary;
  row.unit = "secondary rays";
  row.exceptions = self_hits;
  return row;
}

/// Points of the square [-1, 1]^2, `height` along the y axis, turned by `tilt` radians about the z axis.
Scene mirror_plane(double tilt) {
  const dvec3 across(std::cos(tilt), std::sin(tilt), 0.0);
  const dvec3 along(0.0, 0.0, 1.0);
  return scene_of({{rectangle({.count = SELF_HIT_SPLATS}, along - across, 2.0 * across, -2.0 * along),
                    mirror_material()}});
}

/// Rays from above, along the mirror's normals (0, 1, 0) turned by `TILT` or not.
template <int TILT_PERCENT>
RayQuery ray_at_plane(const Scene& scene, std::mt19937_64& random) {
  const dvec3 across(std::cos(0.01 * TILT_PERCENT), std::sin(0.01 * TILT_PERCENT), 0.0);
  const dvec3 normal(-across.y, across.x, 0.0);
  dvec3 dir = random_unit(random);
  if (glm::dot(dir, normal) > 0.0) dir = -dir;
  const dvec3 target = uniform(random, -0.9, 0.9) * across + dvec3(0.0, 0.0, uniform(random, -0.9, 0.9));
  return world_ray(scene, target - 2.0 * dir, dir - 1e-3 * normal);
}

TEST(SelfHit, MirrorPlane) {
  conclude(mirrored_away(mirror_plane(0.3), ray_at_plane<30>, hard_rays(),
                         "mirrored rays that hit anything, exact plane"));
}

TEST(SelfHit, MirrorPlaneInACellPlane) {
  conclude(mirrored_away(mirror_plane(0.0), ray_at_plane<0>, hard_rays() / 200,
                         "the same, the plane is the middle plane of the root"));
}

TEST(SelfHit, MirrorSphereOutside) {
  for (const bool even : {true, false}) {
    const OrientedPoints points = sphere({.count = SELF_HIT_SPLATS, .even = even}, 1.0);
    conclude(mirrored_away(scene_of({{points, mirror_material()}}), ray_at_sphere, hard_rays() / 2,
                           std::string("mirrored rays that hit anything, exact sphere, ") +
                               (even ? "even" : "random") + " splats"));
  }
}

/// Rays inside a mirror sphere, mirrored three times: they must meet the sphere where it is.
CaseRow bounces_inside(bool even, const std::string& compared, const Settings& settings = {}) {
  const Scene scene =
      scene_of({{flipped(sphere({.count = SELF_HIT_SPLATS, .even = even}, 1.0)), mirror_material()}});
  const double radius = median_radius_root(scene);
  DeviceScene device(scene);
  CaseRow counts;
  std::uint64_t grazing = 0;
  in_batches(hard_rays() / 6, [&](std::size_t first, std::size_t count) {
    std::vector<std::size_t> index = indices(count);
    Segment segment = traced(device,
                             made_rays(scene, first, count,
                                       [](const Scene& inside, std::mt19937_64& random) {
                                         const dvec3 origin =
                                             0.9 * uniform(random, 0.0, 1.0) * random_unit(random);
                                         return world_ray(inside, origin, random_unit(random));
                                       }),
                             settings);
    for (int bounce = 0; bounce < 3; ++bounce) {
      segment = traced(device, mirrored_rays(segment, index), settings);
      counts.count += segment.rays.size();
      for (std::size_t i = 0; i < segment.rays.size(); ++i) {
        const double exact = exit_of_sphere(scene, segment.rays[i]);
        const bool wrong = !(std::abs(double(segment.hits[i].t) - exact) < 0.5 * exact);
        counts.exceptions += wrong ? 1 : 0;
        grazing += wrong && exact < 4.0 * radius ? 1 : 0;
      }
    }
  });
  CaseRow row = device.row(compared);
  row.count = counts.count;
  row.unit = "secondary rays";
  row.exceptions = counts.exceptions;
  row.remark = std::to_string(grazing) + " of them on chords below 4 r";
  return row;
}

TEST(SelfHit, MirrorSphereInside) {
  conclude(bounces_inside(true, "hits off by half the exact chord or more, even splats"));
  // One of 5 million is known to remain.
  conclude_missed(bounces_inside(false, "the same, random splats"), known_of(0, 1));
}

/// `rays` secondary rays through a convex dielectric: in, across, out. The far side must be hit where `exact_exit` says, and
/// what leaves must hit nothing.
CaseRow through_glass(const Scene& scene, MakeRay make, std::size_t rays,
                      double (*exact_exit)(const Scene& scene, const RayQuery& ray),
                      const std::string& compared) {
  DeviceScene device(scene);
  CaseRow counts;
  in_batches(rays / 2, [&](std::size_t first, std::size_t count) {
    std::vector<std::size_t> index = indices(count);
    const Segment primary = traced(device, made_rays(scene, first, count, make));
    const Segment across = traced(device, refracted_rays(scene, primary, index));
    for (std::size_t i = 0; i < across.rays.size(); ++i) {
      const double exact = exact_exit(scene, across.rays[i]);
      counts.exceptions += std::abs(double(across.hits[i].t) - exact) < 0.5 * exact ? 0 : 1;
    }
    const Segment out = traced(device, refracted_rays(scene, across, index));
    counts.exceptions += count_found(out);
    counts.count += across.rays.size() + out.rays.size();
  });
  CaseRow row = device.row(compared);
  row.count = counts.count;
  row.unit = "secondary rays";
  row.exceptions = counts.exceptions;
  return row;
}

TEST(SelfHit, GlassSphere) {
  for (const bool even : {true, false}) {
    const Scene scene =
        scene_of({{sphere({.count = SELF_HIT_SPLATS, .even = even}, 1.0), glass_material(1.5F)}});
    conclude(
        through_glass(scene, ray_at_sphere, hard_rays() / 2, exit_of_sphere,
                      std::string("refracted rays off by half the exact chord or hitting on the way out, ") +
                          (even ? "even" : "random") + " splats"));
  }
}

constexpr double SLAB_TOP = 0.1;

TEST(SelfHit, GlassSlab) {
  OrientedPoints points;
  for (const SurfacePatch& face : box("slab", {2.0, 2.0 * SLAB_TOP, 2.0}, false))
    append(points, face.make({.count = static_cast<std::uint64_t>(2000.0 * face.area)}));
  const Scene scene = scene_of({{points, glass_material(1.5F)}});
  conclude(through_glass(
      scene,
      [](const Scene& slab, std::mt19937_64& random) {
        dvec3 dir = random_unit(random);
        dir.y = -std::abs(dir.y) - 0.2;  // flatter rays come in through the slab's sides
        const dvec3 target(uniform(random, -0.7, 0.7), SLAB_TOP, uniform(random, -0.7, 0.7));
        return world_ray(slab, target - 2.0 * dir, dir);
      },
      hard_rays(),
      [](const Scene& slab, const RayQuery& ray) {
        const double height = slab.root.to_world(dvec3(ray.origin)).y;
        return (-SLAB_TOP - height) / double(ray.dir.y) / slab.root.unit_world;
      },
      "refracted rays off by half the exact way or hitting on the way out"));
}

TEST(SelfHit, WithoutSideRuleTheyAreMany) {
  Settings settings;
  settings.side = SIDE_NONE;
  const OrientedPoints points = sphere({.count = SELF_HIT_SPLATS}, 1.0);
  conclude_failing(mirrored_away(scene_of({{points, mirror_material()}}), ray_at_sphere, hard_rays() / 20,
                                 "mirror sphere outside, no side rule at all", settings));
}

}  // namespace
}  // namespace splatray::testing
