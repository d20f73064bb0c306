// GPU, shaders compiled as C++, and brute force in float64 must agree on what every ray hits, whatever the
// leaf size.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <iostream>
#include <random>

#include "data/shapes.h"
#include "engine/device/host/host_device.h"
#include "engine/device/vulkan/vulkan_device.h"
#include "engine/scene/clip.h"
#include "engine/scene/splat.h"
#include "preprocess/build.h"
#include "preprocess/mesh/sample_mesh.h"
#include "tests/all_tests.h"
#include "tests/gpu/shown_tracer.h"
#include "tests/trace/agreement.h"
#include "tests/trace/different_bits.h"
#include "tests/trace/rays.h"
#include "tests/trace/scenes.h"
#include "tests/trace/twin.h"

namespace splatray::testing {
namespace {

VulkanDevice& shared_device() {
  static VulkanDevice device;
  return device;
}

/// The brute-force answers to `count` primary rays and to the secondary rays they give rise to.
struct Truth {
  std::vector<RayQuery> rays;
  std::vector<TrueHit> hits;

  Truth(const Scene& scene, const BruteForce& brute, std::size_t count, const Settings& settings) {
    const std::vector<RayQuery> primary = random_primary_rays(scene, count, 1);
    const std::vector<TrueHit> primary_hits = all_nearest(brute, primary, settings);
    const std::vector<RayQuery> secondary = secondary_rays(scene, primary, primary_hits, 2);
    const std::vector<TrueHit> secondary_hits = all_nearest(brute, secondary, settings);
    add(primary, primary_hits);
    add(secondary, secondary_hits);
    const std::vector<RayQuery> tertiary = secondary_rays(scene, secondary, secondary_hits, 3);
    add(tertiary, all_nearest(brute, tertiary, settings));
  }

  void add(const std::vector<RayQuery>& more, const std::vector<TrueHit>& answers) {
    rays.insert(rays.end(), more.begin(), more.end());
    hits.insert(hits.end(), answers.begin(), answers.end());
  }
};

void expect_exact(const Agreement& agreement, const std::string& what) {
  std::cout << what << ": " << agreement << '\n';
  EXPECT_EQ(agreement.exceptions(), 0U) << what;
  EXPECT_EQ(agreement.members, 0U) << what;
  EXPECT_EQ(agreement.normal, 0U) << what;
  EXPECT_LT(agreement.depth_most, 0.01) << what;
  EXPECT_GT(agreement.hits, agreement.rays / 10) << what << ": too few hits to mean anything";
}

std::vector<RayHit> intersect_on(const Device& device, const Scene& scene, const std::vector<RayQuery>& rays,
                                 const Settings& settings, const TracerOptions& options = {}) {
  ShownTracer tracer(device, options);
  tracer.upload(scene);
  return tracer.intersect(rays, settings);
}

std::vector<RayHit> gpu_intersect(const Scene& scene, const std::vector<RayQuery>& rays,
                                  const Settings& settings, const TracerOptions& options = {}) {
  return intersect_on(shared_device(), scene, rays, settings, options);
}

/// Compares the GPU with brute force for each scene, by `count` primary rays with all tests; the scenes differ in leaf size only.
void compare_gpu(const std::vector<Scene>& scenes, std::size_t count) {
  const Settings settings;
  const BruteForce brute(scenes.front());
  const Truth truth(scenes.front(), brute, all_or(count, count / 8), settings);
  std::vector<RayHit> first_answers;
  for (const Scene& scene : scenes) {
    const std::vector<RayHit> answers = gpu_intersect(scene, truth.rays, settings);
    expect_exact(agreement_of(brute, truth.hits, answers),
                 "leaf size " + std::to_string(scene.build.leaf_size));
    if (first_answers.empty()) first_answers = answers;
    EXPECT_EQ(different_bits(answers, first_answers), 0U) << "other bits for another leaf size";
    const auto through_references =
        gpu_intersect(scene, truth.rays, settings, {.pools = {.data = DataPool::references}});
    EXPECT_EQ(different_bits(answers, through_references), 0U) << "other bits through references";
  }
  const auto host = intersect_on(HostDevice(), scenes.front(), truth.rays, settings);
  expect_exact(agreement_of(brute, truth.hits, host), "host");
  const DeviceAgreement with_host = device_agreement(truth.rays, host, first_answers);
  std::cout << "host and device: " << with_host << '\n';
  // The host's float64 and double-float may round a blended normal apart: 1 of 150 000 rays to the armadillo, by a last bit.
  EXPECT_EQ(with_host.unlike, 0U) << with_host;
  const bool is_cpu = shared_device().is_cpu();
  const auto twin = twin_intersect(scenes.front(), truth.rays, settings);
  EXPECT_EQ(unlike_answers(truth.rays, twin, first_answers, is_cpu), 0U)
      << "double-float, the twin and the device";
  // Not PAGES_MOST: a program's count of buffers is limited.
  const std::uint64_t page = std::bit_ceil(scenes.front().reference_pool.size()) / (PAGES_MOST / 2);
  for (const DataPool data : {DataPool::copies, DataPool::references}) {
    const auto paged =
        gpu_intersect(scenes.front(), truth.rays, settings, {.pools = {.data = data, .page_elements = page}});
    EXPECT_EQ(different_bits(first_answers, paged), 0U) << "other bits from pages";
  }
}

TestObject sphere_object(std::uint64_t points, bool even, std::uint32_t flags) {
  return {sphere({.count = points, .even = even, .seed = 7}, 1.0), test_material(flags)};
}

void compare_sphere(bool even, std::uint32_t flags) {
  const TestObject object = sphere_object(20000, even, flags);
  compare_gpu({scene_of({object}, 10), scene_of({object}, 4)}, 100000);
}

TEST(Exactness, EvenSphereOneSided) { compare_sphere(true, 0); }
TEST(Exactness, EvenSphereTwoSided) { compare_sphere(true, MATERIAL_TWO_SIDED); }
TEST(Exactness, EvenSphereGlass) { compare_sphere(true, MATERIAL_DIELECTRIC); }
TEST(Exactness, RandomSphereGlass) { compare_sphere(false, MATERIAL_DIELECTRIC); }

TEST(Exactness, GlassInsideARoomOfCoplanarSplats) {
  TestObject room{{}, test_material(0)};
  for (const SurfacePatch& face : box("room", glm::dvec3(4.0), true))
    append(room.points, face.make({.count = 3000}));
  const std::vector<TestObject> objects{room, sphere_object(5000, true, MATERIAL_DIELECTRIC)};
  compare_gpu({scene_of(objects, 10), scene_of(objects, 25)}, 30000);
}

/// A cube of points sampled on its faces, whose discs end at its edges, or which is shaded as a ball.
Scene cube_scene(bool clipped, std::uint32_t flags, std::uint32_t leaf_size) {
  Mesh cube;
  for (int i = 0; i < 8; ++i) cube.vertices.position.emplace_back(i & 1, i >> 1 & 1, i >> 2 & 1);
  cube.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  if (!clipped)
    for (const glm::dvec3& corner : cube.vertices.position) cube.vertices.normal.emplace_back(corner - 0.5);
  Input input;
  InputObject& object = input.objects.emplace_back();
  object.points = sample_surface(cube, weld_positions(cube.vertices.position), 10000, 1, {.clip = true});
  object.material = test_material(flags);
  object.oriented = true;
  object.measured = false;
  BuildParams params;
  params.leaf_size = leaf_size;
  BuildStats stats;
  return build_scene(std::move(input), params, 0, stats);
}

Scene clipped_cube(std::uint32_t flags, std::uint32_t leaf_size) {
  return cube_scene(true, flags, leaf_size);
}

TEST(Exactness, GlassCubeThatIsShadedAsABall) {
  const Scene scene = cube_scene(false, MATERIAL_DIELECTRIC, 10);
  ASSERT_TRUE(any_leans(scene.field_pool));
  compare_gpu({scene, cube_scene(false, MATERIAL_DIELECTRIC, 4)}, 100000);
}

TEST(Exactness, GlassCubeThatEndsAtItsEdges) {
  compare_gpu({clipped_cube(MATERIAL_DIELECTRIC, 10), clipped_cube(MATERIAL_DIELECTRIC, 4)}, 100000);
}

TEST(Exactness, ClipLinesThatAreNotKeptAreNoticed) {
  Scene scene = clipped_cube(0, 10);
  const Settings settings;
  const BruteForce brute(scene);
  const std::vector<RayQuery> rays = random_primary_rays(scene, 20000, 5);
  const auto truth = all_nearest(brute, rays, settings);
  EXPECT_EQ(agreement_of(brute, truth, gpu_intersect(scene, rays, settings)).exceptions(), 0U);
  for (std::uint32_t& clip : scene.clip_pool.edit()) clip = clip == CLIP_NONE ? clip : clip + 0x100;
  EXPECT_GT(agreement_of(brute, truth, gpu_intersect(scene, rays, settings)).exceptions(), 0U)
      << "lines a step further out";
}

/// Discs made ellipses of all directions and aspects, some with a clip line; their lists stay those of the discs.
Scene with_ellipses(Scene scene) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> unit;
  for (const uvec4& words : scene.data_pool) {
    const Splat splat = unpack_splat(words);
    const glm::dvec3 any(unit(random) - 0.5, unit(random) - 0.5, unit(random) - 0.5);
    const glm::dvec3 dir = glm::normalize(glm::cross(splat.normal, any));
    const glm::dvec3 out = glm::cross(splat.normal, dir);
    const std::array<ClipEdge, 1> edge{{{out, splat.center + 0.5 * std::sqrt(splat.radius_squared) * out}}};
    const std::uint32_t clip = unit(random) < 0.3 ? pack_clip(words, edge) : CLIP_NONE;
    scene.clip_pool.edit().push_back(pack_ellipse(words, dir, std::exp(5.0 * unit(random)), clip));
  }
  return scene;
}

TEST(Exactness, EllipsesOneSidedTwoSidedAndGlass) {
  for (const std::uint32_t flags : {0U, MATERIAL_TWO_SIDED, MATERIAL_DIELECTRIC}) {
    const TestObject object = sphere_object(20000, false, flags);
    compare_gpu({with_ellipses(scene_of({object}, 10))}, 50000);
  }
}

/// A sphere of rings whose points are a tenth as far from each other as the rings are, as a scanner would deliver it.
Scene ringed_sphere(std::uint32_t leaf_size) {
  constexpr int RINGS = 40;
  Input input;
  InputObject& object = input.objects.emplace_back();
  for (int ring = 1; ring < RINGS; ++ring) {
    const double polar = M_PI * ring / RINGS;
    const int points = static_cast<int>(20 * RINGS * std::sin(polar));
    for (int i = 0; i < points; ++i) {
      const double turn = 2.0 * M_PI * (i + 0.5 * (ring % 2)) / points;
      const glm::dvec3 place(std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn),
                             std::cos(polar));
      object.points.position.push_back(place);
      object.points.normal.emplace_back(place);
    }
  }
  object.material = test_material(MATERIAL_DIELECTRIC);
  BuildParams params;
  params.leaf_size = leaf_size;
  BuildStats stats;
  Scene scene = build_scene(std::move(input), params, 0, stats);
  EXPECT_GT(stats.ellipses, scene.data_pool.size() * 9 / 10);
  return scene;
}

TEST(Exactness, EllipsesOfRingsWhateverTheTree) {
  SPLATRAY_NIGHTLY();
  compare_gpu({ringed_sphere(10), ringed_sphere(4), ringed_sphere(40)}, 100000);
}

TEST(Exactness, EllipsesTurnedOrShortenedAreNoticed) {
  const Scene scene = with_ellipses(scene_of({sphere_object(5000, true, 0)}));
  const Settings settings;
  const BruteForce brute(scene);
  const std::vector<RayQuery> rays = random_primary_rays(scene, 20000, 5);
  const auto truth = all_nearest(brute, rays, settings);
  const auto exceptions = [&](const Scene& changed) {
    const std::size_t found = agreement_of(brute, truth, gpu_intersect(changed, rays, settings)).exceptions();
    const auto host = intersect_on(HostDevice(), changed, rays, settings);
    return std::min<std::size_t>(found, agreement_of(brute, truth, host).exceptions());
  };
  EXPECT_EQ(exceptions(scene), 0U);
  for (const std::uint32_t step : {1U << 16, 1U << 23}) {  // of the direction, of the factor
    Scene changed = scene;
    for (std::uint32_t& clip : changed.clip_pool.edit()) clip ^= is_ellipse(clip) ? step : 0U;
    EXPECT_GT(exceptions(changed), 0U) << step;
  }
}

class RealModel : public ::testing::TestWithParam<const char*> {};

TEST_P(RealModel, AgreesWithBruteForce) {
  const auto folder = data_folder();
  if (!folder) GTEST_SKIP() << "SPLATRAY_DATA_DIR is not set: real models are not compared";
  if (GetParam() != std::string("nefertiti.ply")) SPLATRAY_NIGHTLY();
  const std::filesystem::path path = *folder / "models" / GetParam();
  compare_gpu({scene_of_file(path, 40000, 10), scene_of_file(path, 40000, 4)}, 100000);
}

INSTANTIATE_TEST_SUITE_P(Exactness, RealModel,
                         ::testing::Values("bunny.ply", "armadillo.ply", "nefertiti.ply", "fandisk.ply"));

TEST(Exactness, ShadersAsCppAgreeToo) {
  const Scene scene = scene_of({sphere_object(5000, false, MATERIAL_DIELECTRIC)});
  const Settings settings;
  const BruteForce brute(scene);
  const Truth truth(scene, brute, 5000, settings);
  expect_exact(agreement_of(brute, truth.hits, twin_intersect(scene, truth.rays, settings)),
               "shaders as C++");
}

TEST(Exactness, GaussianKernelAndNearestAgreeToo) {
  const Scene scene = scene_of({sphere_object(5000, false, 0)});
  const BruteForce brute(scene);
  for (const std::uint32_t kernel : {KERNEL_GAUSSIAN, KERNEL_RIM}) {
    for (const std::uint32_t blend : {BLEND_WINDOW, BLEND_NEAREST}) {
      Settings settings;
      settings.kernel = kernel;
      settings.blend = blend;
      const std::vector<RayQuery> rays = random_primary_rays(scene, 20000, 5);
      Agreement agreement =
          agreement_of(brute, all_nearest(brute, rays, settings), gpu_intersect(scene, rays, settings));
      if (blend == BLEND_NEAREST) agreement.members = 0;  // the shaders do not count a cluster then
      expect_exact(agreement, "kernel " + std::to_string(kernel) + ", blend " + std::to_string(blend));
    }
  }
}

/// Also in leaves of more chunks than the walk remembers the hits of.
TEST(Exactness, DeviceAndTwinFindTheSameWithAllBlends) {
  for (const std::uint32_t leaf_size : {10U, 150U}) {
    const Scene scene = scene_of({sphere_object(5000, false, MATERIAL_DIELECTRIC)}, leaf_size);
    const std::vector<RayQuery> rays = random_primary_rays(scene, 10000, 5);
    for (const std::uint32_t blend :
         {BLEND_WINDOW, BLEND_NEAREST, BLEND_PAPER, BLEND_LEAF, BLEND_COUNT, BLEND_ANY}) {
      Settings settings;
      settings.blend = blend;
      const auto answers = gpu_intersect(scene, rays, settings);
      EXPECT_EQ(
          unlike_answers(rays, twin_intersect(scene, rays, settings), answers, shared_device().is_cpu()), 0U)
          << blend;
    }
  }
}

/// Rays that end at any hit, before t_max: whether they have one is what the first hit says.
TEST(Exactness, AnyHitIsOneOfThem) {
  const Scene scene = scene_of({sphere_object(5000, false, MATERIAL_TWO_SIDED)});
  std::vector<RayQuery> rays = random_primary_rays(scene, 10000, 5);
  const BruteForce brute(scene);
  Settings any;
  any.blend = BLEND_ANY;
  for (const bool ended : {false, true}) {
    const std::vector<TrueHit> truth = all_nearest(brute, rays, {});
    std::mt19937_64 random(4);
    std::uniform_real_distribution<double> share(0.5, 1.5);
    if (ended)
      for (std::size_t i = 0; i < rays.size(); ++i)
        if (truth[i].found) rays[i].t_max = static_cast<float>(truth[i].t_first * share(random));
    const std::vector<RayHit> found[] = {gpu_intersect(scene, rays, any), twin_intersect(scene, rays, any),
                                         intersect_on(HostDevice(), scene, rays, any)};
    std::size_t met = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const bool expected = truth[i].found && (!ended || truth[i].t_first < double(rays[i].t_max));
      met += expected ? 1 : 0;
      for (const std::vector<RayHit>& hits : found) EXPECT_EQ(hits[i].object != NO_OBJECT, expected) << i;
    }
    EXPECT_GT(met, rays.size() / 8);
    EXPECT_LT(met, rays.size());
  }
}

/// A hit, and the ray that has it.
struct OneHit {
  RayQuery ray{};
  RayHit hit{};
};

OneHit one_hit() {
  OneHit one;
  one.ray.dir = vec3(0.0F, 0.6F, 0.8F);
  one.hit.first = pack_splat({glm::dvec3(1000.0), glm::dvec3(0.0, 0.0, -1.0), 400.0, 0});
  one.hit.normal = vec3(0.0F, 0.0F, -1.0F);
  one.hit.t = one.hit.t_first = 1000.0F;
  one.hit.members = 3;
  one.hit.color = 0xFF804020U;
  return one;
}

/// Whether an answer that differs by what `change` does passes for another device's.
template <class Change>
bool may_differ(const Change& change) {
  const OneHit one = one_hit();
  RayHit other = one.hit;
  change(other);
  return unlike_answers({one.ray}, {one.hit}, {other}, false) == 0;
}

TEST(Exactness, WhatDevicesMayDifferInIsBounded) {
  constexpr float STEP = 0x1p-14F;  // of float32 at 1000
  EXPECT_TRUE(may_differ([](RayHit& hit) { hit.t_first += STEP; }));
  EXPECT_FALSE(may_differ([](RayHit& hit) { hit.t_first += 2 * STEP; }));
  EXPECT_TRUE(may_differ([](RayHit& hit) { hit.t += float(20 * MEAN_ERROR); }));
  EXPECT_FALSE(may_differ([](RayHit& hit) { hit.t += float(50 * MEAN_ERROR); }));  // of a depth of 25
  EXPECT_TRUE(may_differ([](RayHit& hit) { hit.normal.x = float(0.9 * MEAN_ERROR); }));
  EXPECT_FALSE(may_differ([](RayHit& hit) { hit.normal.x = float(1.1 * MEAN_ERROR); }));
  EXPECT_TRUE(may_differ([](RayHit& hit) { hit.color += 0x000100U; }));
  EXPECT_FALSE(may_differ([](RayHit& hit) { hit.color += 0x000200U; }));
  EXPECT_FALSE(may_differ([](RayHit& hit) { ++hit.members; }));
  EXPECT_FALSE(may_differ([](RayHit& hit) { hit.object = NO_OBJECT; }));
  EXPECT_FALSE(may_differ([](RayHit& hit) { hit.first.x ^= 1U << 11U; }));
  EXPECT_FALSE(may_differ([](RayHit& hit) { hit.t = NAN; }));
  const OneHit one = one_hit();
  RayHit other = one.hit;
  other.t_first += STEP;
  EXPECT_EQ(unlike_answers({one.ray}, {one.hit}, {other}, true), 1U) << "processors give the same bits";
}

TEST(Exactness, EmptySpaceThatIsTooWideIsNoticed) {
  Scene scene = scene_of({sphere_object(5000, true, 0)});
  const Settings settings;
  const BruteForce brute(scene);
  const std::vector<RayQuery> rays = random_primary_rays(scene, 20000, 9);
  for (std::uint32_t& word : scene.node_pool.edit())
    if (word >> NODE_TAG_SHIFT == NODE_EMPTY) word |= EMPTY_STEPS_MASK;
  const Agreement agreement =
      agreement_of(brute, all_nearest(brute, rays, settings), gpu_intersect(scene, rays, settings));
  EXPECT_GT(agreement.exceptions(), agreement.rays / 100) << agreement;
}

TEST(Exactness, AMovedSplatIsNoticed) {
  const Scene scene = scene_of({sphere_object(5000, true, 0)});
  const Settings settings;
  BruteForce brute(scene);
  const std::vector<RayQuery> rays = random_primary_rays(scene, 20000, 9);
  const std::vector<TrueHit> hits = all_nearest(brute, rays, settings);
  const auto hit = std::find_if(hits.begin(), hits.end(), [](const TrueHit& h) { return h.found; });
  ASSERT_NE(hit, hits.end());
  const Splat& splat = brute.splats()[hit->first];
  brute.move_splat(hit->first, 0.5 * std::sqrt(splat.radius_squared) * splat.normal);
  const Agreement agreement =
      agreement_of(brute, all_nearest(brute, rays, settings), gpu_intersect(scene, rays, settings));
  EXPECT_GT(agreement.exceptions() + agreement.members + agreement.normal, 0U) << agreement;
}

}  // namespace
}  // namespace splatray::testing
