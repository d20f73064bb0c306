// What counts hits that differ from brute force: none do, and a splat that was moved is noticed by every kind of ray.
#include <gtest/gtest.h>

#include <map>

#include "engine/device/vulkan/vulkan_device.h"
#include "tests/bench/exact/exact_count.h"
#include "tests/bench/exact/exact_scenes.h"

namespace splatray::testing {
namespace {

VulkanDevice& shared_device() {
  static VulkanDevice device;
  return device;
}

using Kinds = std::map<std::string, ExactCount>;

Kinds counts_of(ExactScene& scene, std::size_t rays, std::uint64_t seed) {
  Kinds kinds;
  scene.count(rays, seed, [&](const std::string& kind, const ExactCount& count) { kinds[kind].add(count); });
  return kinds;
}

TEST(Exact, NoHitDiffersOfAnyKind) {
  for (const char* name : {"room", "lattice"}) {
    ExactScene scene(shared_device(), exact_scene(name, 3000, "").value());
    for (const auto& [kind, count] : counts_of(scene, 3000, 3)) {
      EXPECT_EQ(count.different_hits(), 0U) << name << ", " << kind;
      EXPECT_GT(count.hits, count.rays / 50) << name << ", " << kind << ": too few hits to mean anything";
    }
  }
}

TEST(Exact, EveryKindNoticesMovedSplats) {
  ExactScene scene(shared_device(), exact_scene("room", 1000, "").value());
  for (std::size_t i = 0; i < scene.splats(); i += 2) scene.move_splat(i, glm::dvec3(20000.0));
  const Kinds kinds = counts_of(scene, 3000, 5);
  EXPECT_EQ(kinds.size(), 5 + ADVERSARIAL.size());
  for (const auto& [kind, count] : kinds) EXPECT_GT(count.different_hits(), 0U) << kind;
}

TEST(Exact, NoHitDiffersInRegions) {
  ExactScene scene(shared_device(), exact_scene("room", 3000, "").value(), true);
  std::uint64_t hits = 0;
  for (const std::uint64_t seed : {1, 2, 3, 4})
    for (const auto& [kind, count] : counts_of(scene, 1000, seed)) {
      EXPECT_EQ(count.different_hits(), 0U) << kind << ", seed " << seed;
      hits += count.hits;
    }
  EXPECT_GT(hits, 4000U) << "too few hits to mean anything";
}

TEST(Exact, OtherSeedsAreOtherRays) {
  ExactScene scene(shared_device(), exact_scene("torus", 500, "").value());
  EXPECT_NE(counts_of(scene, 1000, 6)["random"].hits, counts_of(scene, 1000, 8)["random"].hits);
}

}  // namespace
}  // namespace splatray::testing
