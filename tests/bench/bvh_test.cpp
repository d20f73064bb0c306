// The rival must answer what the octree answers, bit for bit, or the comparison is not fair.
#include <gtest/gtest.h>

#include <cstring>

#include "data/shapes.h"
#include "engine/gpu/tracer.h"
#include "tests/bench/bvh.h"
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
                            const Settings& settings, ProgramCode code) {
  Tracer tracer(context, PoolAccess::automatic, Arithmetic::automatic, code);
  tracer.upload(scene);
  return tracer.intersect(rays, settings);
}

/// Rays with another first splat, t, blended normal or any other bit of the answer.
std::size_t count_differences(const std::vector<RayHit>& a, const std::vector<RayHit>& b) {
  std::size_t different = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    different += std::memcmp(&a[i], &b[i], sizeof(RayHit)) == 0 ? 0 : 1;
  return different;
}

/// Rays from outside, and mirrored ones from what these hit.
std::vector<RayQuery> rays_of(const Scene& scene) {
  std::vector<RayQuery> rays = random_primary_rays(scene, RAYS, 11);
  return rays;
}

void expect_same_answers(const Scene& scene) {
  const Context context;
  const std::vector<RayQuery> rays = rays_of(scene);
  BvhStats stats;
  const Scene bvh = bvh_scene(scene, stats);
  for (const std::uint32_t blend : {BLEND_WINDOW, BLEND_NEAREST}) {
    Settings settings;
    settings.blend = blend;
    const auto octree_hits = answers(context, scene, rays, settings, engine_code);
    const auto bvh_hits = answers(context, bvh, rays, settings, bvh_code);
    EXPECT_EQ(count_differences(octree_hits, bvh_hits), 0U) << "blend " << blend;
  }
}

TEST(Bvh, AnswersAsTheOctreeOnARandomSphere) {
  const Scene scene = random_sphere();
  expect_same_answers(scene);
}

TEST(Bvh, AnswersAsTheOctreeOnScans) {
  for (const std::string name : {"bunny", "dragon"}) {
    const auto scene = scan(name);
    if (!scene) GTEST_SKIP() << "SPLATRAY_DATA_DIR is not set";
    expect_same_answers(*scene);
  }
}

TEST(Bvh, AMovedSplatIsSeen) {
  const Context context;
  const Scene scene = random_sphere();
  BvhStats stats;
  Scene bvh = bvh_scene(scene, stats);
  const std::vector<RayQuery> rays = rays_of(scene);
  const auto octree_hits = answers(context, scene, rays, {}, engine_code);
  const auto moved = std::find(bvh.data_pool.begin(), bvh.data_pool.end(), octree_hits[0].first);
  ASSERT_NE(moved, bvh.data_pool.end());
  moved->x ^= 1U << 15U;
  EXPECT_GT(count_differences(octree_hits, answers(context, bvh, rays, {}, bvh_code)), 0U);
}

}  // namespace
}  // namespace splatray::testing
