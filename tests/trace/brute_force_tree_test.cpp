// The hierarchy in float64 leaves nothing out: its answers are those of brute force, bit for bit.
#include "tests/trace/brute_force_tree.h"

#include <gtest/gtest.h>

#include "data/shapes.h"
#include "tests/hard/support/lattice_soup.h"
#include "tests/property/random_rays.h"
#include "tests/trace/rays.h"
#include "tests/trace/scenes.h"

namespace splatray::testing {
namespace {

std::size_t different(const BruteForce& brute, const BruteForce& tree, const std::vector<RayQuery>& rays) {
  const std::vector<TrueHit> expected = all_nearest(brute, rays, {});
  const std::vector<TrueHit> found = all_nearest(tree, rays, {});
  std::size_t count = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const TrueHit &a = expected[i], &b = found[i];
    const bool same = a.found == b.found && a.t == b.t && a.t_first == b.t_first && a.normal == b.normal &&
                      a.first == b.first && a.members == b.members && a.object == b.object;
    count += same ? 0 : 1;
  }
  return count;
}

/// Rays that look for trouble, and what follows their hits.
std::vector<RayQuery> many_rays(const Scene& scene, const BruteForce& brute) {
  Dice dice(3);
  std::vector<RayQuery> rays = random_rays(scene, brute, 5000, dice);
  const std::vector<RayQuery> next = secondary_rays(scene, rays, all_nearest(brute, rays, {}), 5);
  rays.insert(rays.end(), next.begin(), next.end());
  return rays;
}

TEST(BruteForceTree, AnswersAsBruteForceDoes) {
  const Scene glass =
      scene_of({{sphere({.count = 2000, .seed = 7}, 1.0), test_material(MATERIAL_DIELECTRIC)}});
  for (const Scene& scene : {lattice_soup(), glass}) {
    const BruteForce brute(scene);
    EXPECT_EQ(different(brute, BruteForceTree(scene), many_rays(scene, brute)), 0U);
  }
}

TEST(BruteForceTree, AMovedSplatIsNoticed) {
  const Scene scene = lattice_soup();
  const BruteForce brute(scene);
  BruteForceTree moved(scene);
  moved.move_splat(0, glm::dvec3(3e5, 0.0, 0.0));
  std::vector<RayQuery> rays = random_primary_rays(scene, 1000, 1);
  for (RayQuery& ray : rays) ray.origin = vec3(brute.splats()[0].center - 1e5 * glm::dvec3(ray.dir));
  EXPECT_GT(different(brute, moved, rays), 0U);
}

TEST(BruteForceTree, OfNoSplatsMeetsNothing) {
  RayQuery ray{};
  ray.dir = vec3(0.0F, 0.0F, 1.0F);
  EXPECT_FALSE(BruteForceTree(Scene{}).nearest(ray, {}).found);
}

}  // namespace
}  // namespace splatray::testing
