// Splats that are hard on arithmetic or on preprocess: seen edge-on, on top of each other, with bad attributes,
// much larger than leaves, hit at their very rim or beside the lines where they end.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "data/shapes.h"
#include "engine/scene/clip.h"
#include "engine/scene/splat.h"
#include "tests/hard/support/clouds.h"
#include "tests/hard/support/device_scene.h"
#include "tests/trace/rays.h"

namespace splatray::testing {
namespace {

using glm::dvec3;

constexpr float NOT_A_NUMBER = std::numeric_limits<float>::quiet_NaN();
constexpr double MIDDLE = 1U << (LATTICE_BITS - 1);

/// A number in [low, high).
TEST(Splat, GrazingDiscs) {
  std::mt19937_64 random(1);
  std::vector<Disc> discs;
  for (int i = 0; i < 1000; ++i) {
    // Rays go along x; the disc's plane is 0 to 0.1 degree off that.
    const double tilt = i % 4 == 0 ? 0.0 : std::pow(10.0, uniform(random, -9.0, -2.76));
    const double turn = uniform(random, 0.0, 2.0 * M_PI);
    const dvec3 normal(std::sin(tilt), std::cos(tilt) * std::cos(turn), std::cos(tilt) * std::sin(turn));
    const dvec3 center =
        MIDDLE + dvec3(uniform(random, -8e5, 8e5), uniform(random, -8e5, 8e5), uniform(random, -8e5, 8e5));
    discs.push_back({glm::round(center), normal, uniform(random, 1e3, 1e5)});
  }
  const Scene scene = lattice_scene(discs, test_material(MATERIAL_TWO_SIDED));
  const BruteForce brute(scene);
  std::vector<RayQuery> rays;
  for (int i = 0; i < 50000; ++i) {
    const Splat& splat = brute.splats()[random() % brute.splats().size()];
    const double radius = std::sqrt(splat.radius_squared);
    const dvec3 beside(0.0, uniform(random, -radius, radius), uniform(random, -radius, radius));
    const double height = i % 2 == 0 ? 1.0 : 1e-3;
    rays.push_back(primary_ray(splat.center + height * beside - dvec3(2e6, 0.0, 0.0), {1.0, 0.0, 0.0}));
  }
  DeviceScene device(scene);
  conclude(compare_with_brute_force(device, brute, rays, "discs at 89.9 to 90 degrees", Compared::hits));
}

/// `copies` of one point, and four others that span a scene.
InputObject heap(std::size_t copies, std::uint64_t order_seed) {
  std::vector<Disc> discs(copies, {dvec3(0.1, 0.2, 0.3), {0.0, 0.0, 1.0}, 0.05});
  for (std::size_t i = 0; i < copies; ++i) discs[i].normal = glm::normalize(dvec3(double(i % 40), 0.0, 40.0));
  for (const dvec3& corner : {dvec3(0.0), dvec3(1.0, 0.0, 0.0), dvec3(0.0, 1.0, 0.0), dvec3(1.0)})
    discs.push_back({corner, {0.0, 0.0, 1.0}, 0.2});
  std::mt19937_64 random(order_seed);
  std::shuffle(discs.begin(), discs.end(), random);
  return disc_object(discs, test_material(MATERIAL_TWO_SIDED));
}

TEST(Splat, CoincidentPoints) {
  BuildStats stats;
  const Scene scene = build({heap(10000, 1)}, {}, &stats);
  const Scene shuffled = build({heap(10000, 2)});
  EXPECT_EQ(different_bits(scene.data_pool, shuffled.data_pool), 0U);
  EXPECT_EQ(scene.node_pool, shuffled.node_pool);
  std::mt19937_64 random(3);
  std::vector<RayQuery> rays;
  for (int i = 0; i < 20000; ++i) {
    const dvec3 dir = random_unit(random);
    const dvec3 target = dvec3(0.1, 0.2, 0.3) + 0.04 * random_unit(random);
    rays.push_back(primary_ray(scene.root.to_root(target - dir), dir));
  }
  DeviceScene device(scene);
  CaseRow row = compare_with_brute_force(device, BruteForce(scene), rays, "10 000 copies of one point");
  row.remark += ", " + std::to_string(stats.dropped_duplicates) + " copies dropped, depth " +
                std::to_string(stats.depth);
  conclude(row);
}

/// A sphere whose points `spoil` may change.
InputObject spoilt_sphere(const std::function<void(Points& points, std::size_t i)>& spoil) {
  const OrientedPoints even = sphere({.count = 5000}, 1.0);
  InputObject object;
  object.material = test_material(MATERIAL_TWO_SIDED);
  object.oriented = true;
  object.points.position = even.position;
  for (const dvec3& normal : even.normal) object.points.normal.emplace_back(normal);
  for (std::size_t i = 0; i < even.position.size(); ++i) spoil(object.points, i);
  return object;
}

/// Rays at the unit sphere that miss, or hit with a normal more than 10 degrees off.
CaseRow compare_with_sphere(const Scene& scene, const std::string& what) {
  std::mt19937_64 random(5);
  std::vector<RayQuery> rays;
  for (int i = 0; i < 50000; ++i) {
    const dvec3 dir = random_unit(random);
    rays.push_back(primary_ray(
        scene.root.to_root(0.8 * uniform(random, 0.0, 1.0) * random_unit(random) - 3.0 * dir), dir));
  }
  DeviceScene device(scene);
  const std::vector<RayHit> hits = device.intersect(rays);
  CaseRow row = device.row(what + ": hit, and normal within 10 degrees of the exact sphere's");
  row.count = rays.size();
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const bool found = hits[i].object != NO_OBJECT;
    const dvec3 at =
        scene.root.to_world(dvec3(rays[i].origin) + double(found ? hits[i].t : 0.0F) * dvec3(rays[i].dir));
    row.exceptions +=
        found && glm::dot(glm::normalize(at), dvec3(hits[i].normal)) > std::cos(glm::radians(10.0)) ? 0 : 1;
  }
  return row;
}

TEST(Splat, BadNormals) {
  BuildStats stats;
  const Scene scene = build({spoilt_sphere([](Points& points, std::size_t i) {
                              const vec3 bad[] = {vec3(0.0F), vec3(NOT_A_NUMBER), vec3(INFINITY, 0.0F, 0.0F)};
                              if (i % 10 == 0) points.normal[i] = bad[i / 10 % 3];
                            })},
                            {}, &stats);
  EXPECT_EQ(stats.normals_estimated, 500U);
  conclude(compare_with_sphere(scene, "every 10th normal zero, NaN or infinite"));
}

TEST(Splat, BadRadii) {
  BuildStats stats;
  const Scene scene = build({spoilt_sphere([](Points& points, std::size_t i) {
                              constexpr float BAD[] = {0.0F, -0.1F, NOT_A_NUMBER, INFINITY};
                              points.radius.push_back(i % 10 == 0 ? BAD[i / 10 % 4] : 0.04F);
                            })},
                            {}, &stats);
  EXPECT_EQ(stats.radii_repaired, 500U);
  conclude(compare_with_sphere(scene, "every 10th radius zero, negative, NaN or infinite"));
}

TEST(Splat, BadPositions) {
  BuildStats stats;
  const Scene scene = build({spoilt_sphere([](Points& points, std::size_t i) {
                              if (i % 100 == 0)
                                points.position[i][static_cast<int>(i / 100 % 3)] = double(NOT_A_NUMBER);
                              if (i % 100 == 50) points.position[i].x = 1e300;
                            })},
                            {.radius_scale = 1.5}, &stats);
  EXPECT_EQ(stats.dropped_non_finite, 100U);
  conclude(compare_with_sphere(scene, "2 % of the positions NaN or beyond 1e100"));
}

TEST(Splat, NormalsThatAreNotUnit) {
  const Scene scene = build({spoilt_sphere([](Points&, std::size_t) {})});
  const Scene scaled = build({spoilt_sphere([](Points& points, std::size_t i) {
    constexpr float SCALES[] = {1e-3F, 1e3F, 0x1p60F, 0x1p-60F};
    points.normal[i] *= SCALES[i % 4];
  })});
  std::uint64_t far_off = 0;
  EXPECT_EQ(scene.data_pool.size(), scaled.data_pool.size());
  for (std::size_t i = 0; i < scene.data_pool.size(); ++i) {
    const Splat a = unpack_splat(scene.data_pool[i]);
    const Splat b = unpack_splat(scaled.data_pool[i]);
    far_off += a.center != b.center || glm::length(a.normal - b.normal) > 1e-4 ? 1 : 0;
  }
  conclude({.compared = "splats, those of unit normals",
            .count = scene.data_pool.size(),
            .unit = "splats",
            .exceptions = far_off});
}

TEST(Splat, RadiusMuchLargerThanALeaf) {
  std::mt19937_64 random(7);
  std::vector<Disc> discs;
  for (int i = 0; i < 4000; ++i)
    discs.push_back(
        {{uniform(random, -1.0, 1.0), 0.02 * uniform(random, -1.0, 1.0), uniform(random, -1.0, 1.0)},
         {0.0, 1.0, 0.0},
         0.02});
  BuildStats small_only;
  (void)build({disc_object(discs, test_material(MATERIAL_TWO_SIDED))}, {}, &small_only);
  for (int i = 0; i < 10; ++i) discs.push_back({{0.0, -0.025 - 0.001 * i, 0.0}, {0.001 * i, 1.0, 0.0}, 1.5});
  BuildStats stats;
  const Scene scene = build({disc_object(discs, test_material(MATERIAL_TWO_SIDED))}, {}, &stats);
  DeviceScene device(scene);
  CaseRow row = compare_with_brute_force(device, BruteForce(scene), random_primary_rays(scene, 50000, 9),
                                         "10 discs of 75 radii under 4000 small ones");
  row.remark += ", references a splat " + short_number(1.0 + stats.growth) + ", without the large ones " +
                short_number(1.0 + small_only.growth);
  conclude(row);
}

TEST(Splat, LoneRimHits) {
  std::mt19937_64 random(11);
  const dvec3 normal = glm::normalize(dvec3(1.0, 2.0, 3.0));
  const Scene scene = lattice_scene({{dvec3(MIDDLE), normal, 5e5}}, test_material(MATERIAL_TWO_SIDED));
  const BruteForce brute(scene);
  const Splat& splat = brute.splats()[0].radius_squared > 100.0 ? brute.splats()[0] : brute.splats()[1];
  const dvec3 u = glm::normalize(glm::cross(splat.normal, dvec3(1.0, 0.0, 0.0)));
  const dvec3 v = glm::cross(splat.normal, u);
  std::vector<RayQuery> rays;
  for (int i = 0; i < 50000; ++i) {
    const double turn = uniform(random, 0.0, 2.0 * M_PI);
    const double off = std::copysign(std::exp2(-uniform(random, 1.0, 40.0)), double(i % 2) - 0.5);
    const dvec3 rim = splat.center + std::sqrt(splat.radius_squared) * (1.0 + off) *
                                         (std::cos(turn) * u + std::sin(turn) * v);
    const dvec3 dir = random_unit(random);
    rays.push_back(primary_ray(rim - 1e6 * dir, dir));
  }
  DeviceScene device(scene);
  conclude(compare_with_brute_force(device, brute, rays, "rays 2^-1 to 2^-40 r inside and outside a rim"));
}

/// Some words of clip lines: through the centre, beyond the rim, double, square to each other, random.
std::uint32_t line_words(std::mt19937_64& random, int i) {
  const auto direction = static_cast<std::uint32_t>(random() & 0xFFU);
  const auto line = [](std::uint32_t d, std::uint32_t q) { return q << 8 | (d & 0xFFU); };
  switch (i % 4) {
    case 0:
      return line(direction, CLIP_ZERO) | (CLIP_NONE & 0xFFFF0000U);
    case 1:
      return line(direction, 140) | line(direction, 141) << 16;
    case 2:
      return line(direction, 150) | line(direction + 64, 254) << 16;
    default:
      return static_cast<std::uint32_t>(random());
  }
}

TEST(Splat, HitsBesideClipLines) {
  std::mt19937_64 random(13);
  CaseRow all{.compared = "rays 2^-1 to 2^-38 r beside clip lines: device, brute force"};
  for (int i = 0; i < 12; ++i) {
    const dvec3 normal = i < 3 ? dvec3(i == 0, i == 1, i == 2) : random_unit(random);
    Scene scene = lattice_scene({{dvec3(MIDDLE), normal, 5e5}}, test_material(MATERIAL_TWO_SIDED));
    scene.clip_pool.edit().assign(scene.data_pool.size(), CLIP_NONE);
    const std::size_t large = unpack_radius_squared(scene.data_pool[0]) > 100.0 ? 0 : 1;
    scene.clip_pool.edit()[large] = line_words(random, i);
    const BruteForce brute(scene);
    const Splat& splat = brute.splats()[large];
    std::vector<RayQuery> rays;
    for (const ClipLine& line : unpack_clip(scene.clip_pool[large], scene.data_pool[large])) {
      const dvec3 across = line.across - splat.normal * glm::dot(splat.normal, line.across);
      const double distance = line.limit / glm::length(across);
      for (int ray = 0; ray < 2000; ++ray) {
        const double off = std::copysign(std::exp2(-uniform(random, 1.0, 38.0)), double(ray % 2) - 0.5) * 5e5;
        const dvec3 along = glm::normalize(glm::cross(splat.normal, across)) * uniform(random, -5e5, 5e5);
        const dvec3 place = splat.center + glm::normalize(across) * (distance + off) + along;
        const dvec3 dir = random_unit(random);
        rays.push_back(primary_ray(place - 1e6 * dir, dir));
      }
    }
    DeviceScene device(scene);
    all += compare_with_brute_force(device, brute, rays, "");
  }
  conclude(all);
}

TEST(Splat, HitsBesideRimsOfEllipses) {
  std::mt19937_64 random(17);
  CaseRow all{.compared = "rays 2^-1 to 2^-36 r inside and outside rims of ellipses: device, brute force"};
  for (int i = 0; i < 12; ++i) {
    const dvec3 normal = i < 3 ? dvec3(i == 0, i == 1, i == 2) : random_unit(random);
    Scene scene = lattice_scene({{dvec3(MIDDLE), normal, 5e5}}, test_material(MATERIAL_TWO_SIDED));
    scene.clip_pool.edit().assign(scene.data_pool.size(), CLIP_NONE);
    const std::size_t large = unpack_radius_squared(scene.data_pool[0]) > 100.0 ? 0 : 1;
    const uvec4& words = scene.data_pool[large];
    const dvec3 dir = glm::normalize(glm::cross(unpack_splat(words).normal, random_unit(random)));
    scene.clip_pool.edit()[large] = pack_ellipse(words, dir, std::exp2(uniform(random, 1.0, 8.0)));
    const BruteForce brute(scene);
    const Splat& splat = brute.splats()[large];
    const Ellipse ellipse = unpack_ellipse(scene.clip_pool[large], words);
    std::vector<RayQuery> rays;
    for (int ray = 0; ray < 4000; ++ray) {
      const dvec3 out = glm::normalize(glm::cross(splat.normal, random_unit(random)));
      const double across = glm::dot(ellipse.across, out);
      const double rim = std::sqrt(splat.radius_squared / (1.0 + ellipse.factor * across * across));
      const double off = std::copysign(std::exp2(-uniform(random, 1.0, 36.0)), double(ray % 2) - 0.5);
      const dvec3 dir_to_rim = random_unit(random);
      rays.push_back(primary_ray(splat.center + rim * (1.0 + off) * out - 1e6 * dir_to_rim, dir_to_rim));
    }
    DeviceScene device(scene);
    all += compare_with_brute_force(device, brute, rays, "");
  }
  conclude(all);
}

}  // namespace
}  // namespace splatray::testing
