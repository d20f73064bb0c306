// What changes between frames, and what that must not cost: neither a pipeline nor an upload of the pools.
#include <algorithm>
#include <memory>

#include "engine/base/error.h"
#include "engine/gpu/tiles.h"
#include "engine/image/sample_mean.h"
#include "tests/gpu/shown_tracer.h"
#include "tests/gpu/small_scene.h"

namespace splatray {
namespace {

class FramesTest : public DeviceTest {
 protected:
  void SetUp() override {
    tracer.upload(scene);
    first = center();
    built = tracer.pipelines_built();
  }

  /// The picture's middle pixel.
  vec4 center() { return tracer.render(view, settings).rgba[9 / 2 * 9 + 9 / 2]; }

  void look_from(double x) {
    view.camera.eye = {x, 0.0, 3.0};
    view.camera.target = {x, 0.0, 0.0};
  }

  void expect_changed_without_rebuilding() {
    EXPECT_NE(center(), first);
    EXPECT_EQ(tracer.pipelines_built(), built);
    EXPECT_EQ(tracer.pools_uploaded(), 1U);
  }

  Scene scene = disc_scene();
  View view = disc_view(9, 9);
  Settings settings = plain_settings();
  ShownTracer tracer{device};
  vec4 first{};
  std::uint32_t built = 0;
};

TEST_F(FramesTest, FirstFrameBuildsOnePipeline) { EXPECT_EQ(built, 1U); }

TEST_F(FramesTest, ViewChanges) {
  look_from(3.0);
  expect_changed_without_rebuilding();
}

TEST_F(FramesTest, MaterialsChange) {
  scene.materials[0].phong.diffuse = {1.0F, 0.0F, 0.0F};
  tracer.set_materials(scene.materials);
  expect_changed_without_rebuilding();
}

TEST_F(FramesTest, LightsChangeAndGrowInNumber) {
  scene.lights[0].power *= 0.25F;
  scene.lights.resize(5, scene.lights[0]);
  tracer.look.lights = scene.lights;
  expect_changed_without_rebuilding();
}

TEST_F(FramesTest, ConstantEnvironmentChanges) {
  tracer.set_environment({0, 0, {}, glm::vec3(0.0F, 0.5F, 0.0F)});
  expect_changed_without_rebuilding();
}

TEST_F(FramesTest, EnvironmentPictureIsReplacedWithoutRebuilding) {
  tracer.set_environment({2, 1, std::vector<glm::vec3>(2, glm::vec3(0.25F)), {}});
  first = center();
  built = tracer.pipelines_built();
  tracer.set_environment({4, 3, std::vector<glm::vec3>(12, glm::vec3(0.5F)), {}});
  expect_changed_without_rebuilding();
}

TEST_F(FramesTest, EnvironmentIsSeenAroundTheDisc) {
  const auto corner = [&] { return glm::vec3(tracer.render(view, settings).rgba[0]); };
  EXPECT_EQ(corner(), glm::vec3(0.0F)) << "black before the first environment";
  tracer.set_environment({0, 0, {}, glm::vec3(1.0F, 2.0F, 3.0F)});
  EXPECT_EQ(corner(), glm::vec3(1.0F, 2.0F, 3.0F));
  tracer.set_environment({2, 1, std::vector<glm::vec3>(2, glm::vec3(4.0F, 5.0F, 6.0F)), {}});
  settings.environment_strength = 0.5F;
  EXPECT_EQ(corner(), glm::vec3(2.0F, 2.5F, 3.0F));
}

TEST_F(FramesTest, FeaturesThatReturnAreNotRebuilt) {
  scene.materials[0].phong.mirror = 1.0F;
  scene.materials[0].phong.tint = glm::vec3(1.0F);
  tracer.set_materials(scene.materials);
  (void)center();
  EXPECT_EQ(tracer.pipelines_built(), built + 1);
  scene.materials[0].phong.mirror = 0.0F;
  tracer.set_materials(scene.materials);
  EXPECT_EQ(center(), first);
  EXPECT_EQ(tracer.pipelines_built(), built + 1);
}

TEST_F(FramesTest, SceneIsReplaced) {
  Scene other = disc_scene(2);
  other.materials[0].phong.diffuse = glm::vec3(0.0F);
  tracer.upload(other);
  EXPECT_NE(center(), first);
  EXPECT_EQ(tracer.pools_uploaded(), 2U);
}

TEST_F(FramesTest, SameFrameTwiceIsTheSamePicture) {
  settings.samples = 5;
  EXPECT_TRUE(tracer.render(view, settings).rgba == tracer.render(view, settings).rgba);
}

TEST_F(FramesTest, GrownPictureIsTheRenderedOne) {
  view.width = 61;
  view.height = 43;
  settings.samples = 7;
  tracer.begin(view, settings);
  EXPECT_EQ(tracer.samples(), 0U);
  EXPECT_EQ(tracer.picture().rgba.front(), vec4(0.0F));
  std::uint32_t dispatches = 1;
  while (!tracer.advance(1e-3)) {
    ++dispatches;
    if (dispatches == 20) (void)tracer.intersect(std::vector<RayQuery>(3), settings);
    if (dispatches == 25) (void)tracer.render(disc_view(80, 80), plain_settings());
    if (dispatches == 30) (void)tracer.trace_aov(disc_view(20, 20), settings);
  }
  EXPECT_EQ(dispatches, 7U * ((43 + 7) / 8)) << "a request for no time takes the fewest rows, 8, each time";
  EXPECT_EQ(tracer.samples(), 7U);
  const Image grown = tracer.picture();
  EXPECT_TRUE(grown.rgba == tracer.render(view, settings).rgba);
  settings.samples = 6;
  EXPECT_FALSE(grown.rgba == tracer.render(view, settings).rgba);
}

TEST_F(FramesTest, GrownPictureOfSeveralBlocksIsTheRenderedOne) {
  view.width = view.height = 17;
  settings.samples = 3 * BLOCK_SAMPLES + 2;
  tracer.begin(view, settings);
  while (!tracer.advance(1e-3)) {
    if (tracer.samples() != 2 * BLOCK_SAMPLES) continue;
    Settings fewer = settings;
    fewer.samples = 2 * BLOCK_SAMPLES;
    // Some rows may have one sample more.
    EXPECT_EQ(tracer.picture().rgba.back(), tracer.render(view, fewer).rgba.back());
  }
  EXPECT_TRUE(tracer.picture().rgba == tracer.render(view, settings).rgba);
}

TEST_F(FramesTest, ARangeOfSamplesIsWhatTheWholePictureHasOfThem) {
  view.width = view.height = 17;
  settings.samples = BLOCK_SAMPLES;
  const Image half = tracer.render(view, settings);
  settings.sample_offset = BLOCK_SAMPLES;
  Image both = tracer.render(view, settings);
  EXPECT_FALSE(both.rgba == half.rgba);
  tracer.begin(view, settings);
  while (!tracer.advance(1e-3)) {
  }
  EXPECT_TRUE(tracer.picture().rgba == both.rgba);
  SampleMean before;
  before.add(half.rgba, BLOCK_SAMPLES);
  before.join(both.rgba, 0, BLOCK_SAMPLES);
  settings.sample_offset = 0;
  settings.samples = 2 * BLOCK_SAMPLES;
  EXPECT_TRUE(tracer.render(view, settings).rgba == both.rgba);
}

/// Of several tiles, the last of which had fewer samples when it was stopped.
TEST_F(FramesTest, AnImageStoppedAndKeptIsTheOneOfTheSamplesThatItHas) {
  view.width = 1200;
  view.height = 1000;
  settings.samples = BLOCK_SAMPLES;
  settings.estimate_error = true;
  const auto until = [](double end) { return [end](double share) { return share < end; }; };
  const Image kept = tracer.render(view, settings, until(0.04), Stopped::kept);
  const auto samples = static_cast<std::uint32_t>(tracer.stats().samples);
  ASSERT_GT(samples, 0U);
  ASSERT_LT(samples, settings.samples / 2);
  EXPECT_TRUE(std::isinf(kept.error.front()));
  settings.samples = samples;
  EXPECT_TRUE(tracer.render(view, settings).rgba == kept.rgba);
  settings.samples = samples + 1;
  EXPECT_FALSE(tracer.render(view, settings).rgba == kept.rgba);
  const Image one = tracer.render(view, settings, until(0.0), Stopped::kept);
  EXPECT_EQ(tracer.stats().samples, 1.0) << "where it is stopped before all pixels have a sample";
  settings.samples = 1;
  EXPECT_TRUE(tracer.render(view, settings).rgba == one.rgba);
}

/// Each step is one that somebody may wait for.
TEST(KeptImages, HaveSmallStepsOnAProcessor) {
  const std::unique_ptr<Device> host = open_device(HOST_DEVICE);
  ShownTracer tracer(*host);
  tracer.upload(disc_scene());
  const View view = disc_view(1200, 1000);
  Settings settings = plain_settings();
  settings.samples = 1;
  double before = 0.0, longest = 0.0;
  const auto progress = [&](double share) {
    longest = std::max(longest, share - before);
    before = share;
    return true;
  };
  (void)tracer.render(view, settings, progress, Stopped::kept);
  EXPECT_DOUBLE_EQ(before, 1.0);
  EXPECT_LE(longest * view.width * view.height, PROMPT_PIXELS);
}

TEST_F(FramesTest, AnImageThatIsKeptIsTheSame) {
  view.width = view.height = 17;
  settings.samples = 2 * BLOCK_SAMPLES + 3;
  settings.estimate_error = true;
  const Image dropped = tracer.render(view, settings);
  const Image kept = tracer.render(view, settings, {}, Stopped::kept);
  EXPECT_TRUE(kept.rgba == dropped.rgba && kept.error == dropped.error);
}

TEST_F(FramesTest, AovsAloneAreThoseOfAPicture) {
  settings.aov = true;
  const Image image = tracer.render(view, settings);
  const std::vector<AovPixel> pixels = tracer.trace_aov(view, settings);
  ASSERT_EQ(pixels.size(), image.aov.size());
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    EXPECT_EQ(pixels[i].z, image.aov[i].z);
    EXPECT_EQ(pixels[i].splat, image.aov[i].splat);
  }
  EXPECT_EQ(pixels[4 * 9 + 4].splat & 1U, 1U) << "the disc shows its front";
}

}  // namespace
}  // namespace splatray
