// The viewer's small parts: colours of the screen, resolution in motion, mouse, dropped files, options of a document.
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <random>

#include "app/library/image_file.h"
#include "app/library/request/command_line.h"
#include "app/view/display/display_table.h"
#include "app/view/model/document_request.h"
#include "app/view/thread/resolution.h"
#include "app/view/window/drop.h"
#include "app/view/window/mouse.h"
#include "engine/scene/phong.h"
#include "tests/temp_folder.h"
#include "tests/view/live_documents.h"

namespace splatray {
namespace {

TEST(DisplayTable, IsThePngWithinOneStep) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> exponent(-20.0F, 8.0F);
  for (const double ev : {-3.0, 0.0, 2.5}) {
    const auto table = std::make_unique<DisplayTable>(ev);
    for (int i = 0; i < 100000; ++i) {
      const float radiance = std::exp2(exponent(random));
      const long exact = std::lround(255.0F * display_value(vec3(radiance), ev).x);
      ASSERT_LE(std::abs(exact - (*table)(radiance)), 1) << radiance;
    }
    for (const float odd : {0.0F, -0.0F, -1.0F, std::nanf("")}) EXPECT_EQ((*table)(odd), 0) << odd;
    EXPECT_EQ((*table)(std::numeric_limits<float>::infinity()), 255);
  }
}

TEST(MovingResolution, TakesTheWantedTime) {
  constexpr glm::uvec2 WINDOW{1280, 720};
  for (const double ms_per_pixel : {1e-5, 4e-4, 3e-3}) {
    MovingResolution resolution;
    for (int i = 0; i < 20; ++i) {
      const glm::uvec2 size = scaled_size(WINDOW, resolution.scale(WINDOW, 33.0));
      const double pixels = double(size.x) * size.y;
      resolution.learn(pixels, ms_per_pixel * pixels);
    }
    const double scale = resolution.scale(WINDOW, 33.0), ms = scale * scale * 1280 * 720 * ms_per_pixel;
    EXPECT_LT(ms, 43.0);
    EXPECT_TRUE(scale == 1.0 || ms > 23.0) << ms;
  }
}

TEST(MovingResolution, AThirdOfTheWindowIsWorthWaitingFor) {
  constexpr glm::uvec2 WINDOW{1200, 900};
  for (const double third_ms : {20.0, 60.0, 85.0, 200.0}) {
    MovingResolution resolution;
    for (int i = 0; i < 30; ++i) {
      const double scale = resolution.scale(WINDOW, 50.0, 90.0);
      resolution.learn(scale * scale * 1200 * 900, 9.0 * scale * scale * third_ms);
    }
    const double scale = resolution.scale(WINDOW, 50.0, 90.0), ms = 9.0 * scale * scale * third_ms;
    EXPECT_LT(ms, 90.0 * 1.28) << third_ms;
    if (third_ms < 90.0) {
      EXPECT_GT(scale, 0.29) << third_ms;
    }
    if (third_ms < 45.0) {
      EXPECT_LT(ms, 50.0 * 1.28) << "no slower than asked for where there is enough";
    }
  }
}

TEST(MovingResolution, OneOutlierDoesLittle) {
  MovingResolution resolution;
  const double before = resolution.scale({1280, 720}, 33.0);
  resolution.learn(1000.0, 1e6);
  EXPECT_GE(resolution.scale({1280, 720}, 33.0), 0.7 * before);
  EXPECT_EQ(scaled_size({3, 2}, 0.01), glm::uvec2(1));
}

class MouseTest : public ::testing::Test {
 protected:
  std::optional<Gesture> press(double x, bool over_controls = false) {
    return take(InputEvent::Kind::press, x, over_controls);
  }
  std::optional<Gesture> move(double x) { return take(InputEvent::Kind::move, x, false); }
  std::optional<Gesture> release(double x) { return take(InputEvent::Kind::release, x, false); }
  std::optional<Gesture> take(InputEvent::Kind kind, double x, bool over_controls) {
    return mouse.take({kind, GLFW_MOUSE_BUTTON_LEFT, 0, {x, 0.0}}, over_controls, now);
  }

  Mouse mouse;
  Mouse::Clock::time_point now{};
};

TEST_F(MouseTest, DragsInSteps) {
  EXPECT_FALSE(press(10.0));
  EXPECT_FALSE(move(12.0)) << "too little";
  const auto first = move(20.0), second = move(25.0);
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->action, Action::orbit);
  EXPECT_EQ(first->from_px.x, 10.0) << "nothing is lost";
  EXPECT_EQ(second->from_px.x, 20.0);
  EXPECT_TRUE(mouse.drags(Action::orbit));
  EXPECT_FALSE(release(25.0)) << "no click";
  EXPECT_FALSE(mouse.drags(Action::orbit));
  EXPECT_FALSE(move(30.0));
}

TEST_F(MouseTest, ClicksOnceAndTwice) {
  (void)press(10.0);
  EXPECT_EQ(release(11.0)->action, Action::inspect);
  now += std::chrono::milliseconds(100);
  (void)press(11.0);
  EXPECT_EQ(release(11.0)->action, Action::pivot);
  now += std::chrono::seconds(1);
  (void)press(11.0);
  EXPECT_EQ(release(11.0)->action, Action::inspect);
}

TEST_F(MouseTest, LeavesControlsAlone) {
  EXPECT_FALSE(press(10.0, true));
  EXPECT_FALSE(move(50.0));
  EXPECT_FALSE(release(50.0));
  EXPECT_FALSE(take(InputEvent::Kind::wheel, 10.0, true));
  EXPECT_EQ(take(InputEvent::Kind::wheel, 10.0, false)->action, Action::zoom);
}

TEST(Drop, KindsByName) {
  EXPECT_EQ(drop_kind("a/b.SOCT"), DropKind::scene);
  EXPECT_EQ(drop_kind("b.glb"), DropKind::scene);
  EXPECT_EQ(drop_kind("sky.hdr"), DropKind::environment);
  EXPECT_EQ(drop_kind("camera.json"), DropKind::camera);
  EXPECT_EQ(drop_kind("picture.png"), DropKind::picture);
  EXPECT_EQ(drop_kind("text.doc"), DropKind::unknown);
}

TEST(Drop, FoldersAreScenes) {
  const TempFolder folder;
  EXPECT_EQ(drop_kind(folder.path()), DropKind::scene);
}

TEST(Drop, PastedPathsAndUris) {
  const std::vector<std::filesystem::path> expected = {"/a b/c.ply", "/d.ply", "/e%.ply", "f.ply"};
  EXPECT_EQ(pasted_files("file:///a%20b/c.ply\r\nfile://host/d.ply\n/e%.ply\n\nf.ply"), expected);
  EXPECT_EQ(pasted_files("file:///100%"), std::vector<std::filesystem::path>{"/100%"});
}

TEST(DocumentRequest, ComeBackThroughTheCommandLine) {
  const Scene scene = disc_scene(1);
  Document document = disc_document(scene);
  LoadedPart part = *document.loaded;
  part.asked.source.inputs = {"my scene.ply"};
  document.loaded = std::make_shared<const LoadedPart>(std::move(part));
  document.camera.fov_y_deg = DEFAULT_FOV_Y_DEG;  // orthographic cameras keep none
  document.materials[0].phong.mirror = 0.3F;
  follow_phong(document.materials[0]);
  document.materials[0].coat = 0.25F;
  document.materials[0].flags |= MATERIAL_HIDDEN;
  lights_of(document).push_back({{LIGHT_POINT, {0.1, 0.2, 0.3}, {0.5F, 0.25F, 0.75F}}, {}, true});
  document.request.look.exposure_ev = -0.75;
  document.request.settings.max_bounces = 3;
  document.request.settings.environment_turn = 0.4F;
  document.request.look.up = glm::dvec3(0.0, 0.6, 0.8);
  const Request request = parse_command_line(command_line(request_of(document, 320, 200)));
  const Document again = first_document(scene, facts_of(scene), request);
  EXPECT_TRUE(again.camera == document.camera);
  EXPECT_TRUE(again.request.look.lights == document.request.look.lights);
  EXPECT_TRUE(same_bytes(again.materials, document.materials));
  EXPECT_EQ(again.request.settings.max_bounces, 3U);
  EXPECT_EQ(again.request.settings.environment_turn, 0.4F);
  EXPECT_EQ(again.request.look.environment, "white");
  EXPECT_EQ(up_of(again), up_of(document));
  EXPECT_EQ(request.look.exposure_ev, -0.75);
  EXPECT_EQ(request.view.width, 320U);
}

Request copied_from(const Document& document) {
  return parse_command_line(command_line(request_of(document, 320, 200)));
}

/// Of a file, in the folder where the program runs.
Document loaded_document(const Scene& scene) {
  Request request;
  request.source.inputs = {"discs.ply"};
  return first_document(scene, facts_of(scene), request);
}

TEST(DocumentRequest, ACommandOfTheSceneShownChangesTheLookAlone) {
  const Scene scene = disc_scene(1);
  const Document document = loaded_document(scene);
  Document changed = document;
  changed.request.look.up = glm::dvec3(1.0, 0.0, 0.0);
  changed.camera.eye.x += 1.0;
  changed.request.look.style = LOOK_CLAY;
  changed.materials[0].flags |= MATERIAL_HIDDEN;
  Request request = copied_from(changed);
  ASSERT_TRUE(is_of_scene(document, request));
  const Document shown = shown_as(scene, document, request);
  EXPECT_EQ(shown.loaded, document.loaded);
  EXPECT_EQ(shown.camera.eye, changed.camera.eye);
  EXPECT_EQ(up_of(shown), up_of(changed));
  EXPECT_EQ(look_of(shown), LOOK_CLAY);
  EXPECT_TRUE(same_bytes(shown.materials, changed.materials));

  request.source.inputs = {std::filesystem::current_path() / "x" / ".." / "discs.ply"};
  EXPECT_TRUE(is_of_scene(document, request)) << "the same file by another path";
  request.look.lights.reset();
  EXPECT_FALSE(is_of_scene(document, request)) << "the default light follows the scene's up direction";
  request = copied_from(document);
  EXPECT_TRUE(is_of_scene(document, request));
  request.source.params.seed = 7;
  EXPECT_FALSE(is_of_scene(document, request)) << "other points";
  request = copied_from(document);
  request.source.inputs.push_back("more.ply");
  EXPECT_FALSE(is_of_scene(document, request));
}

TEST(DocumentRequest, AnotherSceneKeepsWhatAPersonChose) {
  const Scene scene = disc_scene(1);
  Document document = loaded_document(scene);
  EXPECT_FALSE(kept_request(document).look.style) << "nothing was chosen";
  EXPECT_FALSE(kept_request(document).look.tone);
  document.request.look.style = LOOK_AO;
  document.request.settings.samples = 99;
  document.request.look.tone = Tone::agx;
  const Request kept = kept_request(document);
  EXPECT_EQ(kept.look.style, LOOK_AO);
  EXPECT_EQ(kept.look.tone, Tone::agx);
  EXPECT_EQ(kept.settings.samples, 99U);
  EXPECT_FALSE(kept.view.eye || kept.look.lights || !kept.look.environment.empty() ||
               !kept.look.objects.empty());
}

TEST(DocumentRequest, AnotherSceneGetsItsOwnBackgroundAndTurn) {
  Document document = loaded_document(disc_scene(1));
  LoadedPart loaded = *document.loaded;
  loaded.first.settings.background = document.request.settings.background = glm::vec3(0.1F);
  loaded.first.settings.environment_turn = document.request.settings.environment_turn = 0.3F;
  document.loaded = std::make_shared<const LoadedPart>(std::move(loaded));
  EXPECT_FALSE(kept_request(document).settings.background) << "it was chosen for the first";
  EXPECT_EQ(kept_request(document).settings.environment_turn, 0.0F);
  show_environment("white", document);
  EXPECT_FALSE(document.request.settings.background) << "it would hide what was asked for";
  document.request.settings.background = glm::vec3(0.2F);
  show_environment("black", document);
  document.request.settings.environment_turn = 0.5F;
  EXPECT_EQ(kept_request(document).settings.background, glm::vec3(0.2F)) << "by a person";
  EXPECT_EQ(kept_request(document).settings.environment_turn, 0.5F);
}

TEST(DocumentRequest, MoreFilesComeBesideTheSceneAsItIsShown) {
  const Scene scene = disc_scene(1);
  Document document = loaded_document(scene);
  document.materials[0].flags |= MATERIAL_HIDDEN;
  const Request request = request_with(document, {"folder/more.ply", scene.object_names[0] + ".obj"});
  EXPECT_EQ(request.source.inputs,
            (SceneFiles{"discs.ply", "folder/more.ply", scene.object_names[0] + ".obj"}));
  ASSERT_EQ(request.look.objects.size(), 1U);
  EXPECT_EQ(request.look.objects[0].object, "0") << "the name will be that of two";
  EXPECT_EQ(request.view.eye, document.camera.eye);
}

}  // namespace
}  // namespace splatray
