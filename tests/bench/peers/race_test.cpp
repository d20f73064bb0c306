// A race must report that its runners do not answer alike, or its times compare different things.
#include <gtest/gtest.h>

#include "data/models.h"
#include "engine/base/error.h"
#include "engine/device/vulkan/vulkan_device.h"
#include "tests/bench/cases/scale_cases.h"
#include "tests/bench/measure/race.h"
#include "tests/bench/measure/splatray_racer.h"
#include "tests/bench/peers/peer_embree_discs.h"
#include "tests/bench/peers/peer_frame.h"
#include "tests/bench/peers/peer_racer.h"
#include "tests/bench/peers/race_rays.h"
#include "tests/trace/scenes.h"

namespace splatray::testing {
namespace {

/// The quick sphere with fewer splats, in memory.
struct SmallRace {
  SmallRace()
      : scene(scene_of({{sphere({.count = 3000, .even = true}, 1.0), test_material(MATERIAL_TWO_SIDED)}})) {
    one = scale_spheres(true).front();
    one.width = one.height = 64;
    one.rays = 1024;
    scene.lights = {{LIGHT_DIRECTIONAL, glm::normalize(glm::dvec3(1.0, 1.0, 1.0)), glm::vec3(1.0F)}};
    prepared.camera = {{0.0, 0.0, 4.0}, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, 30.0, 0.0};
    prepared.diagonal_world = scene.diagonal_world();
    prepared.variants[file_name(one.runs.front().variant)].radius_median_world = 0.04;
    discs = discs_of(scene);
  }

  std::vector<Json> run() {
    const VulkanDevice device;
    ShownTracer tracer(device);
    tracer.upload(scene);
    const Course course(one, prepared, scene);
    SplatrayRacer own(device, tracer, course, BLEND_WINDOW);
    PeerRacer other(std::make_unique<EmbreeDiscs>(discs, Settings{}), "embree window", {}, 0, 0.0, course);
    return race(one, course, {&own, &other}, true);
  }

  Scene scene;
  Case one;
  PreparedCase prepared;
  Discs discs;
};

TEST(Race, RunnersOfTheSameSplatsAgreeInEveryClass) {
  std::vector<std::string> runs;
  for (const Json& record : SmallRace().run()) {
    runs.push_back(record["method"].get<std::string>() + " " + record["rays"].get<std::string>());
    EXPECT_GT(record["speed"]["rays"], 1000.0) << runs.back();
    EXPECT_EQ(record["speed"]["frames"], RACE_ROUNDS);
    const Json& error = record["error"];
    EXPECT_EQ(error.value("wrong_bounces_ppm", 0.0), 0.0) << runs.back();
    EXPECT_LE(error.value("false_shadows_ppm", 0.0), 1000.0) << runs.back();
    EXPECT_LE(error.value("unlike_ppm", 0.0), MOST_UNLIKE_PPM) << runs.back();
  }
  EXPECT_EQ(runs, (std::vector<std::string>{"window primary", "window random", "window shadow",
                                            "window mirror", "embree window primary", "embree window random",
                                            "embree window shadow", "embree window mirror"}));
}

TEST(Race, OtherSplatsAreNoticed) {
  SmallRace small;
  for (std::size_t i = 0; i < small.discs.size(); i += 20) small.discs.list[i].radius *= 0.5F;
  EXPECT_THROW(static_cast<void>(small.run()), Error);
}

// Any-hit rays of splatray and Embree must say the same, and each kind must have rays, those that leave the sphere none that turn back.
TEST(Race, AnyHitRaysOfBothAgree) {
  const SmallRace small;
  const VulkanDevice device;
  ShownTracer tracer(device);
  tracer.upload(small.scene);
  const View view{framing_camera(small.scene, 1.0), 64, 64};
  std::vector<RayQuery> primary;
  visit_bundles(make_frame_params(small.scene, view, {}), 1,
                [&](std::span<const RayQuery> rays, std::span<const std::size_t>) {
                  primary.insert(primary.end(), rays.begin(), rays.end());
                });
  const EmbreeDiscs peer(small.discs, Settings{});
  std::vector<std::string> kinds;
  for (const RaceRays& rays : race_rays(small.scene, primary, tracer.intersect(primary, {}))) {
    kinds.push_back(rays.kind);
    if (rays.samples > 0) continue;
    EXPECT_GT(rays.list.size(), 500U) << rays.kind;
    for (const RayQuery& ray : rays.list)
      ASSERT_TRUE(ray.from_object == NO_OBJECT || glm::dot(ray.dir, ray.from_normal) > 0.0F) << rays.kind;
    if (rays.kind != "occluded") continue;
    Settings any;
    any.blend = BLEND_ANY;
    const std::vector<RayHit> hits = tracer.intersect(rays.list, any);
    std::vector<std::uint8_t> blocked(hits.size());
    occlude_rays(peer, rays.list, blocked);
    std::size_t unlike = 0;
    for (std::size_t i = 0; i < hits.size(); ++i)
      unlike += (hits[i].object != NO_OBJECT) != (blocked[i] != 0) ? 1 : 0;
    EXPECT_LE(1e6 * double(unlike) / double(hits.size()), MOST_UNLIKE_PPM);
  }
  EXPECT_EQ(kinds, (std::vector<std::string>{"frame", "four", "mirrored", "random", "shadow", "occluded"}));
}

}  // namespace
}  // namespace splatray::testing
