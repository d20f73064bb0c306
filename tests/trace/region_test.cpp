// A region ends rays exactly: brute force, which asks of each hit whether it lies in the region, finds the same.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <random>

#include "data/shapes.h"
#include "engine/base/error.h"
#include "engine/device/host/host_device.h"
#include "engine/device/vulkan/vulkan_device.h"
#include "engine/scene/splat.h"
#include "tests/gpu/shown_tracer.h"
#include "tests/trace/agreement.h"
#include "tests/trace/different_bits.h"
#include "tests/trace/rays.h"
#include "tests/trace/scenes.h"
#include "tests/trace/twin.h"

namespace splatray::testing {
namespace {

const VulkanDevice& shared_device() {
  static const VulkanDevice device;
  return device;
}

std::vector<RayHit> answers_of(const Device& device, const Scene& scene, const std::vector<RayQuery>& rays,
                               const Settings& settings, const TracerOptions& options = {}) {
  ShownTracer tracer(device, options);
  tracer.upload(scene);
  return tracer.intersect(rays, settings);
}

Scene ball(std::uint64_t points, std::uint32_t flags, std::uint32_t leaf_size = 10) {
  return scene_of({{sphere({.count = points, .even = false, .seed = 7}, 1.0), test_material(flags)}},
                  leaf_size);
}

HalfSpace random_half_space(std::mt19937_64& random) {
  std::uniform_real_distribution<double> around(-1.0, 1.0);
  HalfSpace half;
  half.point = {0.4 * around(random), 0.4 * around(random), 0.4 * around(random)};
  half.normal = {around(random), around(random), around(random)};
  return half;
}

/// A region of each kind: planes, as many as there may be, boxes kept, dropped and both.
std::vector<Region> regions_of(const Scene& scene) {
  std::mt19937_64 random(5);
  const auto box = [&](double low, double high, double turn_deg) {
    const auto planes = half_spaces({glm::dvec3(low), glm::dvec3(high, 0.9, 0.7), turn_deg}, scene.up);
    return std::vector<HalfSpace>(planes.begin(), planes.end());
  };
  std::vector<Region> regions(6);
  regions[0].kept = {random_half_space(random)};
  regions[1].kept = box(-0.5, 0.6, 30.0);
  regions[2].dropped = box(-0.7, 0.4, 0.0);
  regions[3].kept = box(-0.8, 0.9, 15.0);
  regions[3].dropped = box(-0.2, 0.5, 70.0);
  for (std::uint32_t i = 0; i < REGION_PLANES_MOST; ++i) {
    HalfSpace half = random_half_space(random);
    half.point *= 0.85 / glm::length(half.point);
    half.normal = -half.point;
    regions[4].kept.push_back(half);
  }
  // Planes along the axes, to which rays of pictures run parallel.
  regions[5].kept = {{{0.0, 0.0, 0.3}, {0.0, 0.0, -1.0}}, {{0.1, 0.0, 0.0}, {1.0, 0.0, 0.0}}};
  return regions;
}

/// Primary rays, rays that start inside, and the secondary rays of both.
std::vector<RayQuery> rays_of(const Scene& scene, const BruteForce& brute, const Settings& settings,
                              std::size_t count) {
  std::vector<RayQuery> rays = random_primary_rays(scene, count, 1);
  const std::vector<RayQuery> primary = rays;
  const auto secondary = secondary_rays(scene, primary, all_nearest(brute, primary, settings), 2);
  rays.insert(rays.end(), secondary.begin(), secondary.end());
  for (std::size_t i = 0; i < primary.size() / 4; ++i) {
    RayQuery ray = primary[i];
    ray.origin = scene.root.to_root(glm::dvec3(0.1 * std::sin(double(i)), 0.05, -0.1));
    rays.push_back(ray);
  }
  return rays;
}

void compare(const Scene& scene, const Settings& settings, std::size_t count, const std::string& what) {
  const BruteForce brute(scene);
  const std::vector<RayQuery> rays = rays_of(scene, brute, settings, count);
  const std::vector<TrueHit> truth = all_nearest(brute, rays, settings);
  const auto device = answers_of(shared_device(), scene, rays, settings);
  const Agreement agreement = agreement_of(brute, truth, device);
  std::cout << what << ": " << agreement << '\n';
  EXPECT_EQ(agreement.exceptions() + agreement.members + agreement.normal, 0U) << what;
  EXPECT_GT(agreement.hits, agreement.rays / 50) << what << ": too few hits to mean anything";
  const auto host = answers_of(HostDevice(), scene, rays, settings);
  EXPECT_EQ(different_bits(host, twin_intersect(scene, rays, settings)), 0U) << what << ", twin and host";
  EXPECT_EQ(unlike_answers(rays, device, host, shared_device().is_cpu(), settings), 0U)
      << what << ", host: " << device_agreement(rays, device, host, settings);
}

TEST(Region, EndsRaysWhereBruteForceSaysSo) {
  for (const std::uint32_t flags : {0U, MATERIAL_TWO_SIDED, MATERIAL_DIELECTRIC}) {
    const Scene scene = ball(8000, flags);
    int number = 0;
    for (const Region& region : regions_of(scene)) {
      Settings settings;
      settings.region = region;
      compare(scene, settings, 3000,
              "region " + std::to_string(number++) + " of flags " + std::to_string(flags));
    }
  }
}

TEST(Region, SplatsAlongRaysAreCounted) {
  const Scene scene = ball(8000, MATERIAL_TWO_SIDED);
  const BruteForce brute(scene);
  for (const bool bounded : {false, true}) {
    Settings settings;
    settings.blend = BLEND_COUNT;
    if (bounded) settings.region = regions_of(scene)[3];
    const auto rays = random_primary_rays(scene, 5000, 1);
    const auto truth = all_nearest(brute, rays, settings);
    const auto host = answers_of(HostDevice(), scene, rays, settings);
    const auto device = answers_of(shared_device(), scene, rays, settings);
    EXPECT_EQ(unlike_answers(rays, device, host, shared_device().is_cpu(), settings), 0U);
    EXPECT_EQ(different_bits(twin_intersect(scene, rays, settings), host), 0U);
    std::size_t many = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      ASSERT_EQ(host[i].object == NO_OBJECT ? 0 : host[i].members, truth[i].members) << i;
      many += truth[i].members > 4 ? 1 : 0;
    }
    EXPECT_GT(many, rays.size() / 20);
  }
}

TEST(Region, IsTheSameInAnyTree) {
  const Scene fine = ball(8000, 0, 4), coarse = ball(8000, 0, 40);
  const BruteForce brute(fine);
  for (const Region& region : regions_of(fine)) {
    Settings settings;
    settings.region = region;
    const auto rays = rays_of(fine, brute, settings, 5000);
    EXPECT_EQ(different_bits(answers_of(shared_device(), fine, rays, settings),
                             answers_of(shared_device(), coarse, rays, settings)),
              0U);
  }
}

TEST(Region, PlanesThatAreElsewhereAreNoticed) {
  const Scene scene = ball(8000, MATERIAL_TWO_SIDED);
  const BruteForce brute(scene);
  for (Region region : regions_of(scene)) {
    Settings settings;
    settings.region = region;
    const auto rays = rays_of(scene, brute, settings, 5000);
    const auto truth = all_nearest(brute, rays, settings);
    for (std::vector<HalfSpace>* halves : {&settings.region.kept, &settings.region.dropped})
      for (HalfSpace& half : *halves) half.point += 0.03 * glm::normalize(half.normal);
    EXPECT_GT(agreement_of(brute, truth, answers_of(shared_device(), scene, rays, settings)).exceptions(),
              0U);
  }
}

TEST(Region, ThatHoldsAllChangesNoHit) {
  const Scene scene = ball(8000, MATERIAL_TWO_SIDED);
  const BruteForce brute(scene);
  Settings settings, bounded;
  bounded.region.kept = {{{0.0, 0.0, -9.0}, {0.0, 0.0, 1.0}}};
  bounded.region.dropped = {{{0.0, 0.0, 9.0}, {0.0, 0.0, 1.0}}};
  const auto rays = rays_of(scene, brute, settings, 5000);
  EXPECT_EQ(different_bits(answers_of(shared_device(), scene, rays, settings),
                           answers_of(shared_device(), scene, rays, bounded)),
            0U);
}

TEST(Region, ThatIsEmptyLeavesNothing) {
  const Scene scene = ball(5000, 0);
  Settings settings;
  settings.region.kept = {{{0.0, 0.0, 0.5}, {0.0, 0.0, 1.0}}, {{0.0, 0.0, 0.4}, {0.0, 0.0, -1.0}}};
  for (const RayHit& hit : answers_of(shared_device(), scene, random_primary_rays(scene, 5000, 1), settings))
    ASSERT_EQ(hit.object, NO_OBJECT);
}

TEST(Region, HoldsWhatItsPlanesHold) {
  const auto planes = half_spaces({{-1.0, -2.0, -3.0}, {1.0, 2.0, 3.0}, 90.0}, {0.0, 0.0, 2.0});
  Region region;
  region.kept = {planes.begin(), planes.end()};
  EXPECT_TRUE(region.holds({1.9, 0.9, 2.9}));
  EXPECT_FALSE(region.holds({0.9, 1.9, 2.9})) << "before the box was turned";
  std::swap(region.kept, region.dropped);
  EXPECT_FALSE(region.holds({1.9, 0.9, 2.9}));
  EXPECT_TRUE(region.holds({0.9, 1.9, 2.9}));
  region.kept.assign(REGION_PLANES_MOST + 1, {});
  EXPECT_THROW((void)region_planes({}, region), Error);
}

}  // namespace
}  // namespace splatray::testing
