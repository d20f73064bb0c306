// The host's wide tree must find what the octree finds, bit for bit, whatever vectors its processor has. The truth here is the
// shaders' text over the octree (twin.h), which exactness_test compares with brute force.
#include <gtest/gtest.h>

#include <random>

#include "data/shapes.h"
#include "engine/device/host/host_device.h"
#include "engine/scene/splat.h"
#include "preprocess/build.h"
#include "tests/gpu/shown_tracer.h"
#include "tests/trace/agreement.h"
#include "tests/trace/different_bits.h"
#include "tests/trace/rays.h"
#include "tests/trace/scenes.h"
#include "tests/trace/twin.h"

namespace splatray::testing {
namespace {

/// Of AVX-512, AVX2, SSE, and of any processor.
constexpr std::uint32_t VECTOR_BITS[] = {512, 256, 128, 32};

std::vector<RayHit> host_intersect(const Scene& scene, const std::vector<RayQuery>& rays,
                                   const Settings& settings, std::uint32_t vector_bits = UINT32_MAX) {
  const HostDevice device;
  ShownTracer tracer(device, {.vector_bits = vector_bits});
  tracer.upload(scene);
  return tracer.intersect(rays, settings);
}

/// Rays from outside and those that go on from what they hit.
std::vector<RayQuery> rays_through(const Scene& scene, std::size_t count) {
  const BruteForce brute(scene);
  std::vector<RayQuery> rays = random_primary_rays(scene, count, 11);
  const std::vector<RayQuery> next = secondary_rays(scene, rays, all_nearest(brute, rays, {}), 12);
  rays.insert(rays.end(), next.begin(), next.end());
  return rays;
}

void expect_twins_bits(const Scene& scene, const std::vector<RayQuery>& rays, const Settings& settings = {}) {
  const std::vector<RayHit> expected = twin_intersect(scene, rays, settings);
  for (const std::uint32_t bits : VECTOR_BITS)
    EXPECT_EQ(different_bits(host_intersect(scene, rays, settings, bits), expected), 0U)
        << "vectors of " << bits << " bits";
}

OrientedPoints random_points(std::size_t count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  OrientedPoints points;
  for (std::size_t i = 0; i < count; ++i) {
    points.position.emplace_back(normal(random), normal(random), normal(random));
    points.normal.push_back(glm::normalize(glm::dvec3(normal(random), normal(random), normal(random))));
    points.color.emplace_back(0.5 + 0.4 * std::sin(double(i)), 0.3, 0.8);
  }
  return points;
}

/// Splats of radii from `least` to `most`, lattice units, in place of a scene's own.
void set_radii(Scene& scene, double least, double most) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> exponent(std::log(least), std::log(most));
  for (uvec4& words : scene.data_pool.edit()) {
    Splat splat = unpack_splat(words);
    const double radius = std::exp(exponent(random));
    splat.radius_squared = radius * radius;
    words = pack_splat(splat);
  }
  scene.wide_nodes = {};
}

Scene scene_with_radii(OrientedPoints points, std::uint32_t flags, double radius) {
  Input input;
  InputObject& object = input.objects.emplace_back();
  object.name = "splats";
  object.points.position = points.position;
  for (const glm::dvec3& normal : points.normal) object.points.normal.emplace_back(normal);
  for (const glm::dvec3& color : points.color) object.points.color.emplace_back(color);
  object.points.radius.assign(points.position.size(), static_cast<float>(radius));
  object.material = test_material(flags);
  object.oriented = true;
  BuildStats stats;
  return build_scene(std::move(input), {}, 0, stats);
}

TEST(WideTree, HasTheOctreesBitsWhateverTheVectors) {
  const Scene scene =
      scene_of({{painted(sphere({.count = 6000, .seed = 5}, 1.0),
                         [](glm::dvec3 p) { return glm::dvec3(0.5 + 0.5 * p.x, 0.4, 0.2); }),
                 test_material(MATERIAL_DIELECTRIC)},
                {painted(rectangle({.count = 6000}, {-2.0, -1.0, -2.0}, {0.0, 0.0, 4.0}, {4.0, 0.0, 0.0}),
                         [](glm::dvec3) { return glm::dvec3(0.2); }),
                 test_material(MATERIAL_TWO_SIDED)}});
  ASSERT_FALSE(scene.color_pool.empty());
  ASSERT_FALSE(scene.field_pool.empty());
  const std::vector<RayQuery> rays = rays_through(scene, 10000);
  expect_twins_bits(scene, rays);
  for (const std::uint32_t blend : {BLEND_NEAREST, BLEND_PAPER, BLEND_LEAF}) {
    Settings settings;
    settings.blend = blend;
    expect_twins_bits(scene, rays, settings);
  }
  Settings gaussian;
  gaussian.kernel = KERNEL_GAUSSIAN;
  expect_twins_bits(scene, rays, gaussian);
}

TEST(WideTree, NormalFieldsAndConstantTerms) {
  Scene scene = scene_of({{sphere({.count = 6000, .seed = 5}, 1.0), test_material(MATERIAL_DIELECTRIC)}});
  const std::vector<RayQuery> rays = rays_through(scene, 10000);
  const std::vector<RayHit> before = twin_intersect(scene, rays, {});
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> component(-0.4, 0.4);
  for (std::size_t i = 0; i < scene.field_pool.size(); ++i) {
    if (random() % 3 == 0) continue;
    const glm::dvec3 lean(component(random), component(random), component(random));
    scene.field_pool.edit()[i] = pack_lean(lean, unpack_splat(scene.data_pool[i]).normal);
  }
  ASSERT_TRUE(any_leans(scene.field_pool));
  EXPECT_GT(different_bits(before, twin_intersect(scene, rays, {})), 5000U);
  for (const std::uint32_t blend : {BLEND_WINDOW, BLEND_NEAREST, BLEND_PAPER, BLEND_LEAF}) {
    Settings settings;
    settings.blend = blend;
    expect_twins_bits(scene, rays, settings);
  }
}

TEST(WideTree, SeesAnotherSceneAsAnother) {
  Scene scene = scene_of({{sphere({.count = 500}, 1.0), test_material(0)}});
  const std::vector<RayQuery> rays = rays_through(scene, 2000);
  const std::vector<RayHit> expected = twin_intersect(scene, rays, {});
  Splat moved = unpack_splat(scene.data_pool[250]);
  moved.radius_squared *= 0.25;
  scene.data_pool.edit()[250] = pack_splat(moved);
  EXPECT_GT(different_bits(host_intersect(scene, rays, {}), expected), 0U);
}

TEST(WideTree, LeavesAndNodesThatAreNotFull) {
  for (const std::size_t count : {1, 2, 15, 16, 17, 31, 255, 256, 257, 4095, 4097}) {
    SCOPED_TRACE(count);
    const Scene scene = scene_with_radii(random_points(count, count), MATERIAL_TWO_SIDED, 0.3);
    ASSERT_EQ(scene.data_pool.size(), count);
    expect_twins_bits(scene, random_primary_rays(scene, 2000, count));
  }
}

TEST(WideTree, ManySplatsAtOnePlace) {
  OrientedPoints points = random_points(100, 1);
  for (std::size_t i = 0; i < points.position.size(); ++i) points.position[i] = glm::dvec3(0.0);
  points.position.back() = glm::dvec3(1.0);
  const Scene scene = scene_with_radii(points, MATERIAL_TWO_SIDED, 0.2);
  expect_twins_bits(scene, random_primary_rays(scene, 2000, 4));
}

// Points that were scanned twice, in other colours: of equal splats, all met at once, the one of the least index is the first everywhere.
TEST(WideTree, EqualSplatsOfSeveralColours) {
  OrientedPoints points = random_points(400, 5);
  const std::size_t places = points.position.size();
  for (std::size_t copy = 1; copy < 4; ++copy)
    for (std::size_t i = 0; i < places; ++i) {
      points.position.push_back(points.position[i]);
      points.normal.push_back(points.normal[i]);
      points.color.emplace_back(0.25 * double(copy), 0.9 - 0.2 * double(copy), 0.1);
    }
  const Scene scene = scene_with_radii(points, MATERIAL_TWO_SIDED, 0.3);
  ASSERT_EQ(scene.data_pool.size(), 4 * places);
  Settings settings;
  settings.blend = BLEND_NEAREST;
  const std::vector<RayQuery> rays = random_primary_rays(scene, 2000, 6);
  expect_twins_bits(scene, rays, settings);
  expect_twins_bits(scene, rays);
  const std::vector<TrueHit> truth = all_nearest(BruteForce(scene), rays, settings);
  const std::vector<RayHit> found = host_intersect(scene, rays, settings);
  std::size_t hits = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (!truth[i].found) continue;
    ++hits;
    EXPECT_LT(glm::distance(glm::dvec3(unpack_color(found[i].color)), truth[i].color), 0.02) << i;
  }
  EXPECT_GT(hits, 500U);
}

// A hit that is found late may be the first, and of a splat so large that its window reaches behind what was gone by.
TEST(WideTree, WindowsThatGrow) {
  OrientedPoints points = rectangle({.count = 3000}, {-1.0, 0.0, -1.0}, {0.0, 0.0, 2.0}, {2.0, 0.0, 0.0});
  std::mt19937_64 random(9);
  std::normal_distribution<double> noise(0.0, 0.02);
  for (glm::dvec3& position : points.position) position.y += noise(random);
  Scene scene = scene_with_radii(points, MATERIAL_TWO_SIDED, 0.2);
  set_radii(scene, 2000.0, 0.2 / scene.root.unit_world);
  expect_twins_bits(scene, random_primary_rays(scene, 20000, 6));
}

// More than a blend of vectors has room for, more than count at all.
TEST(WideTree, ThousandsOfMeetings) {
  for (const std::size_t count : {400, 496, 497, 520, 3000}) {
    SCOPED_TRACE(count);
    OrientedPoints points;
    for (std::size_t i = 0; i < count; ++i) {
      points.position.emplace_back(0.0, 1e-4 * double(i) / double(count), 0.0);
      points.normal.emplace_back(0.0, 1.0, 0.0);
    }
    points.position.emplace_back(1.0, 1.0, 1.0);
    points.normal.emplace_back(0.0, 1.0, 0.0);
    const Scene scene = scene_with_radii(points, MATERIAL_TWO_SIDED, 0.5);
    const std::vector<RayQuery> rays = random_primary_rays(scene, 500, 8);
    expect_twins_bits(scene, rays);
  }
}

// Lattice coordinates make rays that are parallel to planes of boxes, run in them, or in the planes of discs.
TEST(WideTree, RaysAlongTheLattice) {
  Scene scene = scene_with_radii(random_points(2000, 2), MATERIAL_TWO_SIDED, 0.2);
  std::vector<RayQuery> rays;
  for (std::size_t i = 0; i < scene.data_pool.size(); ++i)
    for (int axis = 0; axis < 3; ++axis)
      for (const float way : {1.0F, -1.0F}) {
        RayQuery& ray = rays.emplace_back();
        ray = {};
        ray.origin = vec3(unpack_splat(scene.data_pool[i]).center);
        ray.origin[axis] = way > 0.0F ? -1000.0F : 2.2e6F;
        ray.dir = vec3(0.0F);
        ray.dir[axis] = way;
        ray.from_object = NO_OBJECT;
      }
  expect_twins_bits(scene, rays);
}

}  // namespace
}  // namespace splatray::testing
