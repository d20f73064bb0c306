// The rival must answer what the octree answers, bit for bit, or the comparison is not fair.
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>

#include "data/shapes.h"
#include "engine/gpu/tracer.h"
#include "tests/bench/bvh/bvh.h"
#include "tests/bench/cases/random_rays.h"
#include "tests/trace/different_bits.h"
#include "tests/trace/rays.h"
#include "tests/trace/scenes.h"

namespace splatray::testing {
namespace {

constexpr std::size_t RAYS = 100000;

Scene random_sphere() { return scene_of({{sphere({.count = 20000, .even = false}, 1.0), test_material(0)}}); }

/// A scan of the data folder at its vertices; nothing without the folder.
std::optional<Scene> scan(const std::string& name) {
  const auto folder = data_folder();
  if (!folder) return {};
  return scene_of_file(*folder / "models" / (name + ".ply"), 0, 10);
}

std::vector<RayHit> answers(const Context& context, const Scene& scene, const std::vector<RayQuery>& rays,
                            const Settings& settings, ProgramCode code,
                            PoolAccess access = PoolAccess::automatic,
                            Arithmetic arithmetic = Arithmetic::automatic) {
  Tracer tracer(context, {.access = access}, arithmetic, code);
  tracer.upload(scene);
  return tracer.intersect(rays, settings);
}

void expect_same_answers(const Context& context, const Scene& scene, const Scene& bvh,
                         const std::vector<RayQuery>& rays, const Settings& settings) {
  const auto octree_hits = answers(context, scene, rays, settings, engine_code);
  EXPECT_EQ(different_bits(octree_hits, answers(context, bvh, rays, settings, bvh_code)), 0U);
}

/// Rays from outside, and the mirrored ones of those that hit.
void expect_same_answers(const Scene& scene) {
  const Context context;
  BvhStats stats;
  const Scene bvh = bvh_scene(scene, stats);
  const std::vector<RayQuery> rays = random_primary_rays(scene, RAYS, 11);
  std::vector<RayQuery> mirrored;
  const auto hits = answers(context, scene, rays, {}, engine_code);
  for (std::size_t i = 0; i < rays.size(); ++i)
    if (hits[i].object != NO_OBJECT) mirrored.push_back(mirrored_query(rays[i], hits[i]));
  ASSERT_GT(mirrored.size(), RAYS / 10);
  for (const std::uint32_t blend : {BLEND_WINDOW, BLEND_NEAREST}) {
    SCOPED_TRACE("blend " + std::to_string(blend));
    Settings settings;
    settings.blend = blend;
    expect_same_answers(context, scene, bvh, rays, settings);
    expect_same_answers(context, scene, bvh, mirrored, settings);
  }
}

TEST(Bvh, AnswersAsTheOctreeOnARandomSphere) { expect_same_answers(random_sphere()); }

TEST(Bvh, AnswersAsTheOctreeOnScans) {
  for (const std::string name : {"bunny", "dragon", "igea"}) {
    SCOPED_TRACE(name);
    const auto scene = scan(name);
    if (!scene) GTEST_SKIP() << "SPLATRAY_DATA_DIR is not set";
    expect_same_answers(*scene);
  }
}

TEST(Bvh, AnswersAsTheOctreeOnObjectsWithinEachOther) {
  const TestObject outer{sphere({.count = 5000, .even = true}, 1.0), test_material(0)};
  const TestObject inner{sphere({.count = 20000, .even = false, .seed = 5}, 0.5),
                         test_material(MATERIAL_TWO_SIDED)};
  expect_same_answers(scene_of({outer, inner}));
}

TEST(Bvh, AnswersAsTheOctreeInEveryProgram) {
  const Context context;
  const Scene scene = random_sphere();
  BvhStats stats;
  const Scene bvh = bvh_scene(scene, stats);
  const std::vector<RayQuery> rays = random_primary_rays(scene, RAYS / 10, 13);
  for (const PoolAccess access : {PoolAccess::texel, PoolAccess::storage})
    for (const Arithmetic arithmetic : {Arithmetic::double_float, Arithmetic::float64}) {
      const auto octree_hits = answers(context, scene, rays, {}, engine_code, access, arithmetic);
      const auto bvh_hits = answers(context, bvh, rays, {}, bvh_code, access, arithmetic);
      EXPECT_EQ(different_bits(octree_hits, bvh_hits), 0U);
    }
}

TEST(Bvh, AnswersAsTheOctreeOnOneSplat) {
  Scene scene = random_sphere();
  const uvec4 only = scene.data_pool.front();
  scene.node_pool = {NODE_FILLED << NODE_TAG_SHIFT};
  scene.begin_end = {0, 1};
  scene.slab_pool = {SLAB_FULL};
  scene.reference_pool = {0};
  scene.data_pool = {only};
  scene.field_pool.resize(1);
  const Context context;
  BvhStats stats;
  const Scene bvh = bvh_scene(scene, stats);
  std::vector<RayQuery> rays = random_primary_rays(scene, 1000, 3);
  for (RayQuery& ray : rays) ray.dir = glm::normalize(glm::vec3(unpack_splat(only).center) - ray.origin);
  expect_same_answers(context, scene, bvh, rays, {});
}

TEST(Bvh, AMovedSplatIsSeen) {
  const Context context;
  const Scene scene = random_sphere();
  BvhStats stats;
  Scene bvh = bvh_scene(scene, stats);
  const std::vector<RayQuery> rays = random_primary_rays(scene, RAYS, 11);
  const auto octree_hits = answers(context, scene, rays, {}, engine_code);
  const auto hit = std::find_if(octree_hits.begin(), octree_hits.end(),
                                [](const RayHit& one) { return one.object != NO_OBJECT; });
  const auto moved = std::find(bvh.data_pool.begin(), bvh.data_pool.end(), hit->first);
  ASSERT_NE(moved, bvh.data_pool.end());
  moved->x ^= 1U << 15U;
  EXPECT_GT(different_bits(octree_hits, answers(context, bvh, rays, {}, bvh_code)), 0U);
}

}  // namespace
}  // namespace splatray::testing
