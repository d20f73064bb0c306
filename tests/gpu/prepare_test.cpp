// Programs that are built on threads of their own.
#include "engine/base/error.h"
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

/// Scenes that programs differ for, each with its own.
TEST_F(PrepareTest, AProgramIsKnownBeforeThePoolsAreThere) {
  Settings settings = plain_settings();
  settings.aov = true;
  Scene coloured = disc_scene();
  coloured.color_pool = std::vector<std::uint32_t>(coloured.data_pool.size(), 0xFF2040FFU);
  Scene open = disc_scene(2);
  open.materials[1].flags = MATERIAL_TWO_SIDED;
  for (const Scene& scene : {disc_scene(), coloured, open}) {
    ShownTracer alone(device);
    alone.upload(scene);
    const Image expected = alone.render(disc_view(8, 8), settings);
    Tracer tracer(device);
    std::uint32_t built = 0;
    tracer.upload(scene, [&] {
      tracer.prepare(look_of(scene), disc_view(8, 8), settings);
      built = tracer.pipelines_built();
    });
    EXPECT_EQ(built, 2U);
    EXPECT_TRUE(tracer.render(look_of(scene), disc_view(8, 8), settings).rgba == expected.rgba);
    EXPECT_EQ(tracer.pipelines_built(), 2U) << "none but those that were prepared";
  }
}

TEST_F(PrepareTest, BaseColoursAreOfTheProgramThatIsPrepared) {
  Settings settings = plain_settings();
  settings.look = LOOK_LIT;
  settings.albedo = true;
  const Scene scene = disc_scene();
  Tracer tracer(device);
  tracer.upload(scene, [&] { tracer.prepare(look_of(scene), disc_view(8, 8), settings); });
  EXPECT_FALSE(tracer.render(look_of(scene), disc_view(8, 8), settings).albedo.empty());
  EXPECT_EQ(tracer.pipelines_built(), 1U);
}

TEST_F(PrepareTest, ASceneThatIsNotUploadedIsNotThere) {
  const Scene scene = disc_scene();
  Tracer tracer(device);
  EXPECT_THROW(tracer.upload(scene, [] { throw Error(ExitCode::failed, "no"); }), Error);
  EXPECT_THROW((void)tracer.render(look_of(scene), disc_view(8, 8), plain_settings()), Error);
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
