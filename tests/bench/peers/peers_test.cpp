// Peers must answer what they are said to answer, or the comparison is not fair.
#include <gtest/gtest.h>

#include "data/models.h"
#include "engine/image/view.h"
#include "tests/bench/cases/statistics.h"
#include "tests/bench/peers/peer_embree_clusters.h"
#include "tests/bench/peers/peer_embree_discs.h"
#include "tests/bench/peers/peer_embree_mesh.h"
#include "tests/bench/peers/peer_frame.h"
#include "tests/bench/peers/peer_paths.h"
#include "tests/trace/rays.h"
#include "tests/trace/scenes.h"

namespace splatray::testing {
namespace {

constexpr std::size_t RAYS = 2000;

Scene small_sphere(std::uint32_t material_flags) {
  return scene_of({{sphere({.count = 3000, .even = false}, 1.0), test_material(material_flags)}});
}

Settings settings_of(std::uint32_t blend) {
  Settings settings;
  settings.blend = blend;
  return settings;
}

/// Rays whose answers differ from brute force by more than rounding does, of RAYS.
std::size_t count_differences(const Peer& peer, const BruteForce& brute, const Scene& scene,
                              const Settings& settings) {
  const std::vector<RayQuery> rays = random_primary_rays(scene, RAYS, 7);
  const std::vector<TrueHit> truth = all_nearest(brute, rays, settings);
  const std::vector<RayHit> hits = intersect(peer, rays);
  std::size_t different = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const bool found = hits[i].object != NO_OBJECT;
    bool same = found == truth[i].found;
    if (same && found)
      same = angle_deg(glm::dvec3(hits[i].normal), truth[i].normal) < 0.1 &&
             std::abs(hits[i].t - truth[i].t) < 16.0 && hits[i].members == truth[i].members;
    different += same ? 0 : 1;
  }
  return different;
}

/// Allowed: rays at rims, where float32 decides otherwise, and windows cut short (Gathering::end).
constexpr std::size_t FEW = RAYS / 400;

void expect_brute_force(std::uint32_t material_flags, std::uint32_t blend) {
  const Scene scene = small_sphere(material_flags);
  const Discs discs = discs_of(scene);
  const Settings settings = settings_of(blend);
  BruteForce brute(scene);
  const EmbreeDiscs built_in(discs, settings);
  EXPECT_LE(count_differences(built_in, brute, scene, settings), FEW);
  for (const std::size_t group : {1, 8, 64})
    for (const unsigned width : {1U, 8U, 16U}) {
      const EmbreeClusters clusters(discs, settings, group, width);
      EXPECT_LE(count_differences(clusters, brute, scene, settings), FEW)
          << "groups of " << group << ", " << width << " rays a call";
    }
  for (std::size_t i = 0; i < discs.size(); i += 20) brute.move_splat(i, glm::dvec3(2e4));
  EXPECT_GT(count_differences(built_in, brute, scene, settings), 5 * FEW) << "moved splats must be seen";
}

TEST(EmbreePeers, NearestDiscIsThatOfBruteForce) { expect_brute_force(MATERIAL_TWO_SIDED, BLEND_NEAREST); }

TEST(EmbreePeers, WindowIsThatOfBruteForce) { expect_brute_force(MATERIAL_TWO_SIDED, BLEND_WINDOW); }

TEST(EmbreePeers, BackFacesOfOneSidedObjectsAreNotSeen) {
  expect_brute_force(0, BLEND_NEAREST);
  expect_brute_force(0, BLEND_WINDOW);
}

TEST(EmbreePeers, GaussianKernelIsThatOfBruteForce) {
  const Scene scene = small_sphere(MATERIAL_TWO_SIDED);
  const Discs discs = discs_of(scene);
  const BruteForce brute(scene);
  Settings settings = settings_of(BLEND_WINDOW);
  const EmbreeDiscs rim(discs, settings);
  settings.kernel = KERNEL_GAUSSIAN;
  const EmbreeDiscs gaussian(discs, settings);
  EXPECT_LE(count_differences(gaussian, brute, scene, settings), FEW);
  EXPECT_GT(count_differences(rim, brute, scene, settings), 5 * FEW) << "the kernels must differ";
}

TEST(EmbreePeers, NormalFieldsAreThoseOfBruteForce) {
  const Scene scene = small_sphere(MATERIAL_TWO_SIDED);
  ASSERT_FALSE(scene.field_pool.empty());
  const Discs discs = discs_of(scene);
  const BruteForce brute(scene);
  const Settings settings = settings_of(BLEND_NEAREST);
  const EmbreeDiscs curved(discs, settings);
  EXPECT_LE(count_differences(curved, brute, scene, settings), FEW);
  Discs flat_discs = discs;
  flat_discs.slope.clear();
  const EmbreeDiscs flat(flat_discs, settings);
  EXPECT_GT(count_differences(flat, brute, scene, settings), 5 * FEW) << "flat discs must differ";
}

std::size_t count_wrongly_blocked(const Peer& peer, const std::vector<RayQuery>& rays,
                                  const std::vector<TrueHit>& truth) {
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    std::uint8_t blocked = 2;
    peer.occluded(std::span(rays).subspan(i, 1), {&blocked, 1});
    wrong += (blocked == 1) != truth[i].found ? 1 : 0;
  }
  return wrong;
}

TEST(EmbreePeers, ShadowRaysAreBlockedWhereBruteForceHits) {
  for (const std::uint32_t flags : {MATERIAL_TWO_SIDED, 0U}) {
    const Scene scene = small_sphere(flags);
    const Discs discs = discs_of(scene);
    const Settings settings = settings_of(BLEND_WINDOW);
    BruteForce brute(scene);
    std::vector<RayQuery> rays = random_primary_rays(scene, RAYS, 7);
    for (std::size_t i = 0; i < RAYS; i += 2) rays[i].dir = -rays[i].dir;
    const std::vector<TrueHit> truth = all_nearest(brute, rays, settings);
    const EmbreeDiscs built_in(discs, settings);
    EXPECT_LE(count_wrongly_blocked(built_in, rays, truth), FEW);
    for (const unsigned width : {1U, 16U})
      EXPECT_LE(count_wrongly_blocked(EmbreeClusters(discs, settings, 8, width), rays, truth), FEW);
    for (std::size_t i = 0; i < discs.size(); ++i) brute.move_splat(i, glm::dvec3(2e5));
    EXPECT_GT(count_wrongly_blocked(built_in, rays, all_nearest(brute, rays, settings)), 5 * FEW)
        << "moved splats must be seen";
  }
}

TEST(EmbreePeers, PathsInsideAMirroredBallGoOnAndShadowRaysOutsideDoNotEnd) {
  const Scene scene = small_sphere(MATERIAL_TWO_SIDED);
  const Discs discs = discs_of(scene);
  const EmbreeDiscs peer(discs, settings_of(BLEND_WINDOW));
  const float lift = 0.02F / static_cast<float>(scene.root.unit_world);
  const auto count = [&](const glm::dvec3& eye, const PathRays& what) {
    const View view{{eye, {0.0, 0.1, -0.5}, {0.0, 1.0, 0.0}, 30.0, 0.0}, 37, 23};
    std::vector<PathCount> counts;
    trace_paths(peer, make_frame_params(scene, view, {}), 2, what, counts);
    std::pair<std::size_t, std::size_t> sums;
    for (const PathCount& pixel : counts) {
      sums.first += pixel.secondary;
      sums.second += pixel.blocked;
    }
    return sums;
  };
  EXPECT_EQ(count({0.1, 0.2, 0.3}, {{}, 3, lift}).first, 3U * 37U * 23U);
  const auto outside = count({0.0, 0.1, 4.0}, {vec3(0.0F, 0.0F, 1.0F), 0, lift});
  EXPECT_GT(outside.first, 100U);
  EXPECT_EQ(outside.second, 0U);
  const auto inside = count({0.1, 0.2, 0.3}, {vec3(0.0F, 0.0F, 1.0F), 0, lift});
  EXPECT_GT(inside.second, 100U) << "the other side of the ball is in the way";
}

TEST(EmbreePeers, MeshIsSeenWithSmoothNormals) {
  Mesh mesh;
  mesh.vertices.position = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {1.0, 1.0, 0.05}};
  mesh.triangles = {{0, 1, 2}, {3, 2, 1}};
  const RootTransform root{glm::dvec3(-1.0), 1e-6};
  const EmbreeMesh peer(mesh, root);
  RayQuery ray{};
  ray.origin = root.to_root({0.4, 0.4, 0.5});
  ray.dir = vec3(0.0F, 0.0F, -1.0F);
  RayQuery aside = ray;
  aside.origin = root.to_root({-0.4, 0.4, 0.5});
  const std::vector<RayHit> hits = intersect(peer, std::vector<RayQuery>{ray, aside});
  EXPECT_EQ(hits[0].object, 0U);
  EXPECT_NEAR(hits[0].t * root.unit_world, 0.5, 1e-6);
  const double lean_deg = angle_deg(glm::dvec3(hits[0].normal), {0.0, 0.0, 1.0});
  EXPECT_GT(lean_deg, 0.5) << "the normal of the flat triangle alone";
  EXPECT_LT(lean_deg, 3.0);
  EXPECT_EQ(hits[1].object, NO_OBJECT);
}

TEST(EmbreePeers, FramesAreThePicturesOfTheCamera) {
  const Scene scene = small_sphere(MATERIAL_TWO_SIDED);
  const Discs discs = discs_of(scene);
  const EmbreeDiscs peer(discs, settings_of(BLEND_WINDOW));
  const View view{{{0.0, 0.0, 5.0}, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, 30.0, 0.0}, 37, 23};
  const FrameParams frame = make_frame_params(scene, view, {});
  Image one, two;
  EXPECT_GT(trace_frame(peer, frame, 1, one), 0.0);
  trace_frame(peer, frame, 2, two);
  ASSERT_EQ(one.aov.size(), 37U * 23U);
  const AovPixel& middle = one.aov[11 * 37 + 18];
  EXPECT_NEAR(middle.z, 4.0, 0.01);
  EXPECT_GT(middle.normal.z, 0.99F);
  EXPECT_EQ(one.aov.front().object, NO_OBJECT);
  for (std::size_t i = 0; i < one.aov.size(); ++i) {
    EXPECT_EQ(one.aov[i].z, two.aov[i].z);
    EXPECT_EQ(one.aov[i].normal, two.aov[i].normal);
  }
}

}  // namespace
}  // namespace splatray::testing
