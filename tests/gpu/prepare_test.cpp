// Programs that are built on threads of their own.
#include "engine/gpu/runner.h"
#include "tests/gpu/shown_tracer.h"
#include "tests/gpu/small_scene.h"

namespace splatray {
namespace {

class PrepareTest : public DeviceTest {
 protected:
  void SetUp() override { upload(); }

  void upload() {
    const Scene scene = disc_scene();
    runner.scene.upload(scene);
    runner.scene.show(look_of(scene));
    runner.queue->reserve(runner.accumulation, 64 * sizeof(vec4));
    runner.bind(*runner.accumulation);
  }

  /// The pixels of a picture of 8 x 8.
  std::vector<vec4> traced() {
    runner.run(aim(dispatch(), {0, 0, 8, 8}));
    std::vector<vec4> means(64);
    runner.queue->download(*runner.accumulation, std::as_writable_bytes(std::span(means)));
    return means;
  }
  [[nodiscard]] Dispatch dispatch() { return runner.picture_dispatch(disc_view(8, 8), plain_settings()); }
  void prepare(const Dispatch& what) { runner.queue->prepare(what, runner.scene.bindings()); }

  Runner runner{device, {}};
};

TEST_F(PrepareTest, AProgramIsBuiltOnceAndTracesTheSame) {
  prepare(dispatch());
  prepare(dispatch());
  EXPECT_EQ(runner.queue->programs_built(), 1U);
  const std::vector<vec4> prepared = traced();
  prepare(dispatch());
  EXPECT_EQ(runner.queue->programs_built(), 1U);
  ShownTracer tracer(device);
  tracer.upload(disc_scene());
  EXPECT_TRUE(prepared == tracer.render(disc_view(8, 8), plain_settings()).rgba);
}

TEST_F(PrepareTest, AnotherSceneMayComeWhileItIsBuilt) {
  prepare(dispatch());
  upload();
  EXPECT_GT(traced()[27].w, 0.0F);
  EXPECT_EQ(runner.queue->programs_built(), 1U);
}

TEST_F(PrepareTest, WhatIsNeverRunIsWaitedForAtTheEnd) {
  prepare(dispatch());
  prepare(runner.aov_dispatch(disc_view(8, 8), plain_settings()));
  EXPECT_EQ(runner.queue->programs_built(), 2U);
}

/// Beside the picture's own, where they are asked for.
TEST_F(PrepareTest, APicturesAovsHaveTheirs) {
  ShownTracer tracer(device);
  tracer.upload(disc_scene());
  Settings settings = plain_settings();
  settings.aov = true;
  const Image image = tracer.render(disc_view(8, 8), settings);
  EXPECT_EQ(tracer.pipelines_built(), 2U);
  EXPECT_NE(image.aov[27].object, NO_OBJECT);
}

}  // namespace
}  // namespace splatray
