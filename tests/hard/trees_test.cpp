// Tree error: what the octree finds against brute force over all splats, must be nothing. Small scenes of several
// kinds, three leaf sizes, primary, secondary and adversarial rays.
#include <gtest/gtest.h>

#include <cmath>

#include "data/shapes.h"
#include "tests/hard/support/clouds.h"
#include "tests/hard/support/device_scene.h"
#include "tests/hard/support/lattice_soup.h"
#include "tests/trace/rays.h"

namespace splatray::testing {
namespace {

using glm::dvec3;

constexpr std::array<std::uint32_t, 3> LEAF_SIZES = {4, 10, 40};
constexpr std::size_t SCENES = 5;

Scene glass_sphere(std::uint32_t leaf_size) {
  return scene_of({{sphere({.count = 1500, .even = false, .seed = 7}, 1.0), glass_material(1.5F)}},
                  leaf_size);
}

Scene mirror_torus(std::uint32_t leaf_size) {
  return scene_of({{torus({.count = 1500}, 0.7, 0.3, -M_PI, M_PI), mirror_material()}}, leaf_size);
}

Scene room_with_glass(std::uint32_t leaf_size) {
  TestObject room{{}, test_material(0)};
  for (const SurfacePatch& face : box("room", dvec3(4.0), true))
    append(room.points, face.make({.count = 150}));
  return scene_of({room, {sphere({.count = 700}, 1.0), glass_material(1.33F)}}, leaf_size);
}

/// Discs anywhere, of radii over three decades.
Scene soup(std::uint32_t leaf_size) {
  std::mt19937_64 random(29);
  std::uniform_real_distribution<double> exponent(-3.0, 0.0);
  std::vector<Disc> discs;
  for (int i = 0; i < 1500; ++i)
    discs.push_back({random_unit(random) * 2.0, random_unit(random), std::pow(10.0, exponent(random))});
  return build({disc_object(discs, test_material(MATERIAL_TWO_SIDED))},
               {.leaf_size = leaf_size, .normal_fields = false});
}

/// Random rays, rays along cell planes and between corners of cells, and what follows from their hits.
struct AllRays {
  std::vector<RayQuery> rays;
  std::vector<TrueHit> hits;

  AllRays(const Scene& scene, const BruteForce& brute, std::size_t count) {
    std::vector<RayQuery> primary = random_primary_rays(scene, count / 4, 31);
    std::mt19937_64 random(37);
    while (primary.size() < count / 2) {
      const dvec3 origin = lattice_point(random);
      dvec3 dir = lattice_point(random) - origin + dvec3(0.0, 0.0, 1.0);
      if (primary.size() % 2 == 0) dir[static_cast<int>(random() % 3)] = 0.0;
      if (dir != dvec3(0.0)) primary.push_back(primary_ray(origin, dir));
    }
    add(brute, primary, count);
    std::vector<RayQuery> last = primary;
    for (std::size_t begin = 0; rays.size() < count;) {
      const std::vector<TrueHit> last_hits(hits.begin() + std::ptrdiff_t(begin), hits.end());
      begin = rays.size();
      last = secondary_rays(scene, last, last_hits, begin);
      if (last.empty()) return;
      add(brute, last, count);
    }
  }

 private:
  void add(const BruteForce& brute, std::vector<RayQuery>& more, std::size_t most) {
    more.resize(std::min(more.size(), most - rays.size()));
    const std::vector<TrueHit> answers = all_nearest(brute, more, {});
    rays.insert(rays.end(), more.begin(), more.end());
    hits.insert(hits.end(), answers.begin(), answers.end());
  }
};

/// Compares the scene in all leaf sizes; the answers must be the same bits, too.
void expect_no_tree_error(Scene (*make)(std::uint32_t leaf_size)) {
  const BruteForce brute(make(LEAF_SIZES[0]));
  const AllRays all(make(LEAF_SIZES[0]), brute, hard_rays() / SCENES);
  std::vector<RayHit> first;
  for (const std::uint32_t leaf_size : LEAF_SIZES) {
    DeviceScene device(make(leaf_size));
    const std::vector<RayHit> answers = device.intersect(all.rays);
    CaseRow row = compare_answers(device.row("device, brute force, leaf size " + std::to_string(leaf_size)),
                                  brute, all.rays, all.hits, answers);
    row.remark +=
        ", " + short_number(double(device.counter(COUNT_TESTS)) / double(row.count)) + " tests a ray";
    conclude(row);
    if (first.empty()) first = answers;
    EXPECT_EQ(different_bits(first, answers), 0U) << "other bits for leaf size " << leaf_size;
  }
}

TEST(TreeError, GlassSphere) { expect_no_tree_error(glass_sphere); }
TEST(TreeError, MirrorTorus) { expect_no_tree_error(mirror_torus); }
TEST(TreeError, RoomWithGlass) { expect_no_tree_error(room_with_glass); }
TEST(TreeError, SoupOfRadii) { expect_no_tree_error(soup); }
TEST(TreeError, SplatsOnCellPlanes) { expect_no_tree_error(lattice_soup); }

TEST(TreeError, AMovedSplatIsNoticed) {
  const Scene scene = soup(10);
  BruteForce brute(scene);
  DeviceScene device(scene);
  brute.move_splat(0, dvec3(1000.0, 0.0, 0.0));
  std::vector<RayQuery> rays;
  std::mt19937_64 random(41);
  for (int i = 0; i < 1000; ++i) {
    const dvec3 dir = random_unit(random);
    rays.push_back(primary_ray(brute.splats()[0].center - 1e4 * dir, dir));
  }
  conclude_failing(compare_with_brute_force(device, brute, rays, "one splat moved in brute force only"));
}

}  // namespace
}  // namespace splatray::testing
