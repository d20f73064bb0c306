#include <cmath>

#include "tests/gpu/shown_tracer.h"
#include "tests/gpu/small_scene.h"

namespace splatray {
namespace {

/// A ray down the z axis from z = 0.8 world, moved sideways.
RayQuery ray_at(const Scene& scene, double x_world) {
  RayQuery query{};
  query.origin = scene.root.to_root({x_world, 0.0, 0.8});
  query.dir = {0.0F, 0.0F, -1.0F};
  query.from_object = NO_OBJECT;
  return query;
}

using QueryTest = DeviceTest;

TEST_F(QueryTest, AnswersEachRayInItsPlace) {
  const Scene scene = disc_scene();
  ShownTracer tracer(device);
  tracer.upload(scene);
  std::vector<RayQuery> queries;
  for (int i = 0; i < 1000; ++i) queries.push_back(ray_at(scene, i % 3 == 0 ? 0.3 : 0.7));
  const std::vector<RayHit> hits = tracer.intersect(queries, plain_settings());
  ASSERT_EQ(hits.size(), queries.size());
  const auto expected_t = static_cast<float>(0.8 / scene.root.unit_world);
  for (std::size_t i = 0; i < hits.size(); ++i) {
    EXPECT_EQ(hits[i].object, i % 3 == 0 ? 0U : NO_OBJECT) << i;
    if (i % 3 == 0) {
      EXPECT_NEAR(hits[i].t, expected_t, 1.0F) << i;
      EXPECT_EQ(hits[i].first, scene.data_pool[0]) << i;
    } else {
      EXPECT_TRUE(std::isinf(hits[i].t)) << i;
    }
  }
}

TEST_F(QueryTest, MoreRaysThanADispatchHoldsAreAllAnswered) {
  const Scene scene = disc_scene();
  ShownTracer tracer(device);
  tracer.upload(scene);
  std::vector<RayQuery> queries((1U << 20U) + 77, ray_at(scene, 0.7));
  queries.back() = ray_at(scene, 0.3);
  Settings settings = plain_settings();
  settings.counters = true;
  const std::vector<RayHit> hits = tracer.intersect(queries, settings);
  EXPECT_EQ(hits.back().object, 0U);
  EXPECT_EQ(hits[hits.size() - 2].object, NO_OBJECT);
  EXPECT_EQ(tracer.stats().counters[COUNT_PRIMARY], queries.size());
  EXPECT_EQ(tracer.stats().counters[COUNT_HITS], 1U);
}

TEST_F(QueryTest, NoRaysGiveNoHits) {
  ShownTracer tracer(device);
  tracer.upload(disc_scene());
  EXPECT_TRUE(tracer.intersect({}, plain_settings()).empty());
}

TEST_F(QueryTest, ShadingSettingsShareOnePipeline) {
  const Scene scene = disc_scene();
  ShownTracer tracer(device);
  tracer.upload(scene);
  Settings settings = plain_settings();
  const std::vector<RayQuery> queries = {ray_at(scene, 0.0)};
  (void)tracer.intersect(queries, settings);
  settings.shadows = true;
  settings.order = ORDER_LINEAR;
  (void)tracer.intersect(queries, settings);
  EXPECT_EQ(tracer.pipelines_built(), 1U);
}

}  // namespace
}  // namespace splatray
