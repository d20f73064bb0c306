// The property test can fail: a splat that is not where the truth has it is noticed, and rounding is no excuse for it.
#include <gtest/gtest.h>

#include <sstream>

#include "data/shapes.h"
#include "engine/device/vulkan/vulkan_device.h"
#include "engine/scene/splat.h"
#include "tests/property/judge.h"
#include "tests/property/round.h"
#include "tests/trace/agreement.h"
#include "tests/trace/rays.h"
#include "tests/trace/scenes.h"
#include "tests/trace/twin.h"

namespace splatray::testing {
namespace {

TEST(PropertyProof, AMovedSplatIsNoticed) {
  const VulkanDevice device;
  ShownTracer tracer(device);
  RoundCounts good, spoilt;
  std::ostringstream said_good, said_spoilt;
  run_round(1, tracer, good, said_good);
  EXPECT_EQ(good.exceptions, 0U) << said_good.str();
  EXPECT_GT(good.hits, good.rays / 20);
  run_round(1, tracer, spoilt, said_spoilt, true);
  EXPECT_GT(spoilt.exceptions, 0U);
  EXPECT_NE(said_spoilt.str().find("--seed 1;"), std::string::npos) << said_spoilt.str();
}

/// Hits lost or made up by the tracer where one disc's slab is `steps` of its finest steps too high.
std::size_t exceptions_with_slab_raised(std::uint32_t steps) {
  Scene scene = scene_of({{rectangle({.count = 1}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}), test_material(0)}});
  const BruteForce brute(scene);
  const Settings settings;
  const std::vector<RayQuery> rays = random_primary_rays(scene, 2000, 1);
  scene.slab_pool.edit().at(0) += steps << 12U;
  const Agreement found =
      agreement_of(brute, all_nearest(brute, rays, settings), twin_intersect(scene, rays, settings));
  EXPECT_GT(found.hits, 100U);
  return found.exceptions();
}

TEST(PropertyProof, AMisplacedSlabIsNoticed) {
  EXPECT_EQ(exceptions_with_slab_raised(0), 0U);
  EXPECT_GT(exceptions_with_slab_raised(2), 0U);
}

/// A ray that misses a disc's rim by `beside` lattice units, given the disc as it is; the verdict on an answer that hits.
Verdict verdict_on_a_rim_hit(double beside) {
  const Scene scene =
      scene_of({{rectangle({.count = 1}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}), test_material(0)}});
  BruteForce brute(scene);
  const Splat splat = brute.splats().front();
  RayQuery ray{};
  ray.origin = vec3(splat.center + 1000.0 * splat.normal);
  ray.dir = vec3(-splat.normal);
  ray.from_object = NO_OBJECT;
  const Settings settings;
  brute.move_splat(0, {std::sqrt(splat.radius_squared) + beside, 0.0, 0.0});
  const TrueHit truth = brute.nearest(ray, settings);
  EXPECT_EQ(truth.found, beside <= 0.0);
  RayHit answer{};
  answer.normal = vec3(splat.normal);
  answer.t = answer.t_first = 1000.0F;
  answer.first = brute.words().front();
  answer.object = 0;
  answer.members = 1;
  return Judge(brute, settings).judge(ray, truth, answer);
}

TEST(PropertyProof, OnlyRoundingMakesATie) {
  EXPECT_EQ(verdict_on_a_rim_hit(-1.0), Verdict::right);
  EXPECT_EQ(verdict_on_a_rim_hit(0x1p-26), Verdict::tie);
  EXPECT_EQ(verdict_on_a_rim_hit(0x1p-16), Verdict::wrong);
}

}  // namespace
}  // namespace splatray::testing
