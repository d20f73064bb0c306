// Pictures that grow, what a change of the document costs, and that the end is the headless picture.
#include "app/view/thread/progressive.h"

#include <thread>

#include "app/library/picture/denoise.h"
#include "app/library/shot/environment.h"
#include "app/library/shot/lights.h"
#include "app/library/shot/resolve.h"
#include "app/view/display/device_picture.h"
#include "engine/base/error.h"
#include "engine/device/vulkan/command_queue.h"
#include "tests/gpu/shown_tracer.h"
#include "tests/view/live_documents.h"

namespace splatray {
namespace {

constexpr glm::uvec2 SIZE{67, 43};

class ProgressiveTest : public DeviceTest {
 protected:
  void SetUp() override {
    live.open(scene);
    first = finish().back()->image.rgba;
  }

  /// Shows the document and works until nothing is left to do; returns the pictures.
  std::vector<SharedFrame> finish() {
    progressive.show(document, SIZE);
    std::vector<SharedFrame> frames;
    while (const auto when = progressive.next_work()) {
      std::this_thread::sleep_until(*when);
      if (SharedFrame frame = progressive.work([] { return false; })) frames.push_back(frame);
    }
    return frames;
  }

  /// The picture that the headless program makes of the document, with or without its noise.
  Image headless(bool denoises = false) {
    ShownTracer tracer(device);
    Scene shown = *scene;
    shown.materials = document.materials;
    shown.lights = resolve_lights(shown, document.request, document.camera);
    shown.up = up_of(document);
    tracer.upload(shown);
    tracer.set_environment(load_environment(document.request.look.environment));
    const View view{document.camera, SIZE.x, SIZE.y};
    Settings settings = resolve_settings(shown, document.request);
    settings.aov = settings.estimate_error = denoises;
    Image image = tracer.render(view, settings);
    if (denoises) (void)remove_noise(image, base_colors(tracer, tracer.look, view, settings));
    return image;
  }

  /// The document, changed, ends in the headless picture, without another upload of the pools.
  void expect_live_change() {
    const std::vector<SharedFrame> frames = finish();
    ASSERT_GE(frames.size(), 2U);
    EXPECT_TRUE(frames.front()->moving);
    EXPECT_FALSE(frames.back()->moving);
    EXPECT_EQ(frames.back()->samples, document.request.settings.samples);
    EXPECT_EQ(frames.back()->pools_uploaded, 1U);
    EXPECT_TRUE(frames.back()->image.rgba == headless().rgba);
    EXPECT_FALSE(frames.back()->image.rgba == first);
  }

  SharedScene scene = shared_discs();
  Document document = disc_document(*scene);
  LiveScene live{device};
  Progressive progressive{live, "device"};
  std::vector<vec4> first;  ///< pixels of the document before a change
};

TEST_F(ProgressiveTest, EqualDocumentMakesNoWork) { EXPECT_TRUE(finish().empty()); }

TEST_F(ProgressiveTest, Camera) {
  document.camera.eye.x = document.camera.target.x = 0.25;
  expect_live_change();
}

TEST_F(ProgressiveTest, Materials) {
  document.materials[0].phong.diffuse = {0.5F, 0.25F, 0.125F};
  document.materials[0].phong.mirror = 0.5F;
  document.materials[0].phong.tint = vec3(1.0F);
  expect_live_change();
}

TEST_F(ProgressiveTest, HiddenObject) {
  document.materials[0].flags |= MATERIAL_HIDDEN;
  document.materials[1].phong.diffuse = vec3(0.25F);
  expect_live_change();
}

TEST_F(ProgressiveTest, Lights) {
  lights_of(document).push_back({{LIGHT_POINT, {0.0, 0.5, 1.0}, vec3(0.5F)}, {}, true});
  expect_live_change();
}

TEST_F(ProgressiveTest, EnvironmentAndUp) {
  document.request.look.environment = "studio";
  document.request.look.up = {0.0, 0.0, 1.0};
  document.request.settings.environment_turn = 0.25F;
  expect_live_change();
}

/// Colours and distances of LOOK_SEEN: the brute truth of an orthographic view of two discs.
TEST_F(ProgressiveTest, WhatMovesIsSeenWithoutNoise) {
  document.request.look.style = LOOK_LIT;
  document.camera.eye.x = document.camera.target.x = 0.1;
  const std::vector<SharedFrame> once = finish();
  document.camera.eye.x = document.camera.target.x = 0.0;
  (void)finish();
  document.camera.eye.x = document.camera.target.x = 0.1;
  const std::vector<SharedFrame> again = finish();
  const Frame &moving = *once.front(), &same = *again.front();
  ASSERT_TRUE(moving.moving && moving.is_seen);
  std::size_t hits = 0;
  for (std::size_t i = 0; i < moving.image.rgba.size(); ++i) {
    const vec4& pixel = moving.image.rgba[i];
    if (moving.view.width == same.view.width && moving.view.height == same.view.height) {
      EXPECT_EQ(pixel, same.image.rgba[i]);
    }
    if (!(pixel.w > 0.0F)) continue;
    ++hits;
    EXPECT_NEAR(pixel.w, document.camera.eye.z, 1e-3)
        << "the discs' plane, whatever the device clips rays to";
    EXPECT_EQ(vec3(pixel), vec3(document.materials[0].phong.diffuse)) << "facing the eye: its colour";
  }
  EXPECT_GT(hits, moving.image.rgba.size() / 20);
}

TEST_F(ProgressiveTest, WhatMovesIsAsBrightAsThePictureAtRest) {
  document.request.look.style = LOOK_LIT;
  const auto mean = [](const Frame& frame) {
    double sum = 0.0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < frame.image.rgba.size(); ++i)
      if (frame.image.rgba[i].w > 0.0F) sum += frame.display[4 * i], ++count;
    return sum / double(count);
  };
  document.request.look.exposure_ev = -1.5;
  const double rest = mean(*finish().back());
  document.camera.eye.x = document.camera.target.x = 0.05;
  EXPECT_NEAR(mean(*finish().front()), rest, 0.05 * rest);
}

TEST_F(ProgressiveTest, EndsWithoutNoiseAsASavedPictureDoes) {
  document.request.look.style = LOOK_LIT;
  document.request.settings.samples = 5;
  const std::vector<SharedFrame> frames = finish();
  ASSERT_GE(frames.size(), 3U);
  const Frame &traced = **(frames.end() - 2), &end = *frames.back();
  EXPECT_TRUE(end.denoised && !traced.denoised);
  EXPECT_EQ(end.samples, 5U);
  EXPECT_TRUE(traced.image.rgba == headless().rgba);
  EXPECT_TRUE(end.image.rgba == headless(true).rgba);
  EXPECT_FALSE(end.image.rgba == traced.image.rgba);

  LoadedPart loaded = *document.loaded;
  loaded.asked.output.denoise = false;
  document.loaded = std::make_shared<const LoadedPart>(std::move(loaded));
  document.request.settings.samples = 2;
  EXPECT_FALSE(finish().back()->denoised) << "--keep-noise";
}

TEST_F(ProgressiveTest, AChangeDropsTheFilteredPicture) {
  document.request.look.style = LOOK_LIT;
  document.request.settings.samples = 3;
  progressive.show(document, SIZE);
  SharedFrame frame;
  const auto work = [&] {
    std::this_thread::sleep_until(progressive.next_work().value());
    if (SharedFrame next = progressive.work([] { return false; })) frame = next;
  };
  while (!frame || frame->samples < 3) work();
  EXPECT_FALSE(progressive.work([] { return true; }))
      << "who waits is not kept waiting by what guides the filter";
  work();  // the filter has begun
  document.camera.eye.x = document.camera.target.x = 0.2;
  const SharedFrame end = finish().back();
  EXPECT_TRUE(end->denoised);
  EXPECT_TRUE(end->image.rgba == headless(true).rgba);
}

TEST_F(ProgressiveTest, EveryPictureIsWhole) {
  document.camera.eye.x = document.camera.target.x = 0.1;
  for (const SharedFrame& frame : finish()) {
    EXPECT_EQ(frame->image.rgba.size(), std::size_t{frame->view.width} * frame->view.height);
    EXPECT_EQ(frame->display.size(), 4 * frame->image.rgba.size());
    const bool background = glm::all(glm::equal(vec3(frame->image.rgba.back()), vec3(1.0F)));
    EXPECT_TRUE(background) << "the last row is traced too";
  }
}

TEST_F(ProgressiveTest, ExposureOnlyColours) {
  document.request.look.exposure_ev = -2.0;
  document.request.look.tone = Tone::none;
  const std::vector<SharedFrame> frames = finish();
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_FALSE(frames[0]->moving);
  EXPECT_EQ(frames[0]->samples, document.request.settings.samples);
  EXPECT_NEAR(frames[0]->display.front(), 137, 1) << "sRGB of 1/4";
}

TEST_F(ProgressiveTest, FacingShowsBackFacesOfOneSidedObjects) {
  document.mode = ViewMode::facing;
  document.camera.eye = {0.0, 0.0, -3.0};
  const SharedFrame frame = finish().back();
  const AovPixel& middle = frame->image.aov[SIZE.y / 2 * SIZE.x + SIZE.x / 2];
  EXPECT_NE(middle.object, NO_OBJECT);
  EXPECT_EQ(middle.splat & 1U, 0U) << "its back";
  document.materials[0].flags |= MATERIAL_HIDDEN;
  document.materials[1].flags |= MATERIAL_HIDDEN;
  for (const AovPixel& pixel : finish().back()->image.aov) EXPECT_EQ(pixel.object, NO_OBJECT);
}

TEST_F(ProgressiveTest, HeatMapsCount) {
  for (const ViewMode mode : {ViewMode::tests, ViewMode::steps}) {
    document.mode = mode;
    const SharedFrame frame = finish().back();
    EXPECT_EQ(frame->mode, mode);
    EXPECT_GT(frame->range.high, 0.0);
  }
}

TEST_F(ProgressiveTest, StoppedWorkGoesOn) {
  document.mode = ViewMode::normal;
  document.camera.eye.x = document.camera.target.x = 0.1;
  progressive.show(document, {640, 480});
  ASSERT_TRUE(progressive.work([] { return true; })) << "coarse pictures are not stopped";
  EXPECT_FALSE(progressive.work([] { return true; }));
  ASSERT_TRUE(progressive.next_work());
  EXPECT_TRUE(progressive.work([] { return false; }));
  EXPECT_FALSE(progressive.next_work());
}

/// Pictures that are shown from the device that traces them.
class SharedProgressiveTest : public ProgressiveTest {
 protected:
  void SetUp() override { live.open(scene); }

  std::vector<SharedFrame> show() { return show(on_device); }
  std::vector<SharedFrame> show(Progressive& shows) {
    std::vector<SharedFrame> frames;
    shows.show(document, SIZE);
    while (const auto when = shows.next_work()) {
      std::this_thread::sleep_until(*when);
      if (SharedFrame frame = shows.work([] { return false; })) frames.push_back(frame);
    }
    return frames;
  }

  /// How far what is shown is from what the host would show of this image, of 255.
  int most_apart(const Frame& frame, const std::vector<vec4>& rgba) {
    const Display display(exposure_of(document), resolve_tone(document.request));
    const std::vector<std::uint8_t> expected = std::make_unique<DisplayTable>(display)->rgba(rgba);
    std::vector<std::uint8_t> shown(expected.size());
    EXPECT_EQ(device.queue->wait(), VK_SUCCESS);
    CommandQueue(device).download(frame.shown->pixels, std::as_writable_bytes(std::span(shown)));
    int most = 0;
    for (std::size_t i = 0; i < shown.size(); ++i)
      most = std::max(most, std::abs(int{shown[i]} - int{expected[i]}));
    return most;
  }

  Progressive on_device{live, "device", &device};
};

TEST_F(SharedProgressiveTest, EndsInTheHeadlessPictureAndBringsNoneToTheHost) {
  for (const double x : {0.1, 0.2}) {
    document.camera.eye.x = document.camera.target.x = x;
    const std::vector<SharedFrame> frames = show();
    ASSERT_GE(frames.size(), 2U);
    EXPECT_TRUE(frames.front()->moving);
    for (const SharedFrame& frame : frames) {
      ASSERT_TRUE(frame->shown);
      EXPECT_TRUE(frame->display.empty() && frame->image.rgba.empty());
      EXPECT_EQ(frame->image.width, frame->view.width);
    }
    EXPECT_EQ(frames.back()->samples, document.request.settings.samples);
    EXPECT_LE(most_apart(*frames.back(), headless().rgba), 1);
  }
}

TEST_F(SharedProgressiveTest, EndsWithoutNoiseAndAnExposureOnlyColours) {
  document.request.look.style = LOOK_LIT;
  document.request.settings.samples = 4;
  const std::vector<SharedFrame> frames = show();
  EXPECT_TRUE(frames.front()->is_seen);
  const std::vector<vec4> expected = headless(true).rgba;
  EXPECT_TRUE(frames.back()->denoised && frames.back()->image.rgba == expected);
  EXPECT_LE(most_apart(*frames.back(), expected), 1);
  document.request.look.exposure_ev = -2.0;
  const std::vector<SharedFrame> again = show();
  ASSERT_EQ(again.size(), 1U);
  EXPECT_LE(most_apart(*again.back(), expected), 1);
}

/// As on a GPU, where no byte of a picture comes to the host.
TEST_F(SharedProgressiveTest, TheNoiseIsTakenOutWhereThePictureIs) {
  Progressive there(live, "device", &device, true);
  document.request.look.style = LOOK_LIT;
  for (const std::uint32_t samples : {4U, 66U}) {  // more than run on the device in one mean
    document.request.settings.samples = samples;
    const std::vector<vec4> expected = headless(true).rgba;
    for (const double exposure_ev : {0.0, -2.0}) {
      document.request.look.exposure_ev = exposure_ev;
      const std::vector<SharedFrame> frames = show(there);
      EXPECT_TRUE(frames.back()->denoised && frames.back()->image.rgba.empty());
      EXPECT_LE(most_apart(*frames.back(), expected), 1) << samples;
      EXPECT_EQ(frames.size() == 1, exposure_ev != 0.0) << "only coloured anew";
    }
  }
  document.camera.eye.x = document.camera.target.x = 0.1;
  EXPECT_TRUE(show(there).back()->denoised);
}

TEST_F(SharedProgressiveTest, AnExposureColoursWhatTheDeviceStillHas) {
  (void)show();
  document.request.look.exposure_ev = -2.0;
  const std::vector<SharedFrame> frames = show();
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_LE(most_apart(*frames.back(), headless().rgba), 1);
  // While another picture is begun the last one is not there any more.
  document.camera.eye.x = document.camera.target.x = 0.1;
  on_device.show(document, {640, 480});
  while (!on_device.work([] { return false; })) std::this_thread::sleep_until(on_device.next_work().value());
  std::this_thread::sleep_until(on_device.next_work().value());
  EXPECT_FALSE(on_device.work([] { return true; })) << "some rows of the picture at rest";
  document.request.look.exposure_ev = 1.0;
  on_device.show(document, {640, 480});
  EXPECT_FALSE(on_device.work([] { return true; }));
  EXPECT_LE(most_apart(*show().back(), headless().rgba), 1);
}

TEST_F(ProgressiveTest, EnvironmentThatCannotBeReadIsReportedOnce) {
  document.request.look.environment = "/missing.hdr";
  EXPECT_THROW((void)finish(), Error);
  EXPECT_FALSE(progressive.next_work());
  document.camera.eye.x = document.camera.target.x = 0.1;
  EXPECT_FALSE(finish().empty()) << "with the environment before";
}

}  // namespace
}  // namespace splatray
