#include "app/view/ui/panels.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <tuple>

#include "app/library/camera_file.h"
#include "app/library/materials.h"
#include "app/view/model/attempt.h"
#include "app/view/model/document_request.h"
#include "app/view/thread/live_scene.h"
#include "app/view/ui/panel_parts.h"
#include "engine/gpu/pools.h"
#include "engine/scene/splat.h"
#include "tests/readers/read_error.h"
#include "tests/view/documents.h"
#include "tests/view/gui_driver.h"

namespace splatray {
namespace {

Document document_of(std::size_t objects) {
  Document document = box_document({1.0, 2.0, 3.0}, 2.0);
  LoadedPart loaded;
  for (std::size_t i = 0; i < objects; ++i)
    loaded.object_names.push_back(i == 1 ? "" : "part " + std::to_string(i));
  loaded.materials = std::vector<Material>(objects, named_material("matte"));
  document.materials = loaded.materials;
  document.loaded = std::make_shared<const LoadedPart>(std::move(loaded));
  document.request.look.style = LOOK_PAPER;
  if (objects > 0) lights_of(document).resize(2);
  return document;
}

Frame some_frame(ViewMode mode) {
  Frame frame;
  frame.image.width = 640;
  frame.image.height = 360;
  frame.samples = 3;
  frame.scale = 0.5;
  frame.ms = 41.0;
  frame.mode = mode;
  frame.stats.trace_ms = 40.0;
  frame.pool_bytes.at(BIND_DATA_POOL) = 123456789;
  frame.device = "llvmpipe (LLVM 15.0.6, 256 bits)";
  return frame;
}

bool hidden(const Document& document, std::size_t object) {
  return (document.materials[object].flags & MATERIAL_HIDDEN) != 0;
}

/// All members of a document: whoever adds one must name it here.
bool same(const Document& a, const Document& b) {
  const auto members = [](const Document& document) {
    const auto& [loaded, request, camera, materials, mode, eye_dome, point_size, measures, bounds_min_world,
                 bounds_max_world] = document;
    return std::tie(loaded, request, camera, mode, eye_dome, point_size, measures, bounds_min_world,
                    bounds_max_world);
  };
  return same_bytes(a.materials, b.materials) && members(a) == members(b);
}

TEST(PanelsTest, AllPanelsRunOverAnyDocumentAndChangeNothing) {
  for (const std::size_t objects : {0U, 1U, 300U})
    for (const glm::vec2& size : {glm::vec2(1280, 720), glm::vec2(1920, 1080), glm::vec2(320, 240)})
      for (const double scale : {1.0, 2.0}) {
        GuiDriver gui(size.x, size.y, scale);
        gui.document = document_of(objects);
        for (const char* section : {"Points", "Regions", "Measures", "Lights", "Environment", "Camera",
                                    "Quality", "Cache", "Splat under the cursor", "Statistics"})
          gui.open_section(section);
        const Document before = gui.document;
        const Inspected inspected{.object = 1, .object_name = "", .radius_world = 1e-3};
        const Work work{"reading dragon.ply", 0.3};
        for (int mode = 0; mode < VIEW_MODE_COUNT; ++mode) {
          const Frame frame = some_frame(static_cast<ViewMode>(mode));
          gui.document.mode = frame.mode;
          gui.view = {&frame, &inspected, 17.0, &work};
          gui.state.show_help = mode % 2 == 1;
          const Requests requests = gui.frame();
          EXPECT_TRUE(requests.commands.empty() && !requests.save && !requests.open && !requests.cancel);
        }
        gui.document.mode = before.mode;
        EXPECT_TRUE(same(gui.document, before));
      }
}

TEST(PanelsTest, DialogsRunAndCanBeCancelled) {
  for (bool PanelState::*open :
       {&PanelState::show_open, &PanelState::show_save, &PanelState::show_sheet, &PanelState::show_record}) {
    GuiDriver gui(1280, 720);
    gui.document = document_of(1);
    gui.state.*open = true;
    const char* title = open == &PanelState::show_open    ? "Open"
                        : open == &PanelState::show_save  ? "Save the picture"
                        : open == &PanelState::show_sheet ? "Save a drawing to scale"
                                                          : "Record";
    const Requests requests = gui.click(title, {"cancel"});
    EXPECT_FALSE(gui.state.*open);
    EXPECT_FALSE(requests.save || requests.open);
  }
}

TEST(PanelsTest, ACheckBoxHidesAnObject) {
  GuiDriver gui(1280, 720);
  gui.document = document_of(300);
  gui.click("/objects", {2, "##visible"});
  EXPECT_TRUE(hidden(gui.document, 2));
  EXPECT_FALSE(hidden(gui.document, 1));
  gui.click("/objects", {2, "##visible"});
  EXPECT_FALSE(hidden(gui.document, 2));
}

TEST(PanelsTest, HideAllMeansTheObjectsListed) {
  GuiDriver gui(1280, 720);
  gui.document = document_of(300);
  gui.state.object_filter = "part 29";
  gui.click("##column", {"hide all"});
  for (std::size_t i = 0; i < 300; ++i) EXPECT_EQ(hidden(gui.document, i), i == 29 || i >= 290) << i;
}

TEST(PanelsTest, APresetReplacesTheMaterialButKeepsItHidden) {
  GuiDriver gui(1280, 720);
  gui.document = document_of(3);
  gui.document.materials[1].flags |= MATERIAL_HIDDEN;
  gui.click("/objects", {1, "object 1"});
  EXPECT_EQ(gui.state.object, 1U);
  gui.click("##column", {1, "preset"});
  gui.click("##Combo", {"gold"});
  EXPECT_EQ(gui.document.materials[1].phong.tint, named_material("gold").phong.tint);
  EXPECT_TRUE(hidden(gui.document, 1));
  EXPECT_EQ(gui.document.materials[0].phong.tint, named_material("matte").phong.tint);
  gui.click("##column", {1, "as loaded"});
  EXPECT_TRUE(same_bytes(gui.document.materials, gui.document.loaded->materials));
}

TEST(PanelsTest, ALookWithoutMaterialsSaysSoAndOffersOneThatHasThem) {
  for (const std::uint32_t look : {LOOK_SCAN, LOOK_CLAY, LOOK_AO, LOOK_LIT, LOOK_PAPER}) {
    GuiDriver gui(1280, 720);
    gui.document = document_of(1);
    gui.document.request.look.style = look;
    if (look == LOOK_LIT || look == LOOK_PAPER) {
      EXPECT_FALSE(gui.can_click("##column", {0, "look lit"})) << look;
      continue;
    }
    gui.click("##column", {0, "look lit"});
    EXPECT_EQ(look_of(gui.document), LOOK_LIT) << look;
  }
}

TEST(PanelsTest, OnlyColoursThatThereAreAreOffered) {
  for (const std::vector<std::string>& sources :
       {std::vector<std::string>{"rgb", "plain", "height"}, std::vector<std::string>{"plain", "height"}}) {
    GuiDriver gui(1280, 1600);
    gui.document = document_of(1);
    LoadedPart loaded = *gui.document.loaded;
    loaded.color_sources = sources;
    gui.document.loaded = std::make_shared<const LoadedPart>(std::move(loaded));
    gui.click("##column", {"Points"});
    gui.click("##column", {"colours"});
    EXPECT_EQ(gui.can_click("##Combo", {"rgb"}), sources.front() == "rgb");
    gui.click("##Combo", {"height"});
    EXPECT_EQ(gui.document.request.look.attributes.color_by, "height");
  }
}

TEST(PanelsTest, NamesOfFactsDoNotReachTheirValues) {
  for (const double scale : {1.0, 2.0}) {
    const GuiDriver gui(1280, 720, scale);
    ImGui::NewFrame();
    ImGui::SetNextWindowSize({600.0F, 600.0F});
    ImGui::Begin("facts");
    std::vector<std::string> names = {"x", "a column's name that is longer than any of ours"};
    for (const auto& pool : pool_kinds()) names.emplace_back(pool.name);
    for (const std::string& name : names) {
      fact(name.c_str(), "12");
      const float name_end =
          ImGui::GetWindowPos().x + ImGui::GetCursorPosX() + ImGui::CalcTextSize(name.c_str()).x;
      EXPECT_GT(ImGui::GetItemRectMin().x, name_end) << name;
    }
    ImGui::End();
    ImGui::Render();
  }
}

TEST(PanelsTest, CoordinatesFitIntoTheirBoxes) {
  std::vector<NamedDocument> documents = navigated_documents();
  documents.push_back({"survey", box_document({560000.123456, 5900000.654321, 120.25}, 50.0)});
  for (const auto& [name, shown] : documents) {
    GuiDriver gui(1280, 1600);
    gui.document = document_of(1);
    gui.document.camera = shown.camera;
    gui.open_section("Camera");
    // The boxes of three numbers are as wide as the first, whether beside or below each other.
    const float room =
        gui.width("##column", {"eye", 0, "##numbers", 0, ""}) - 2.0F * ImGui::GetStyle().FramePadding.x;
    for (int axis = 0; axis < 3; ++axis) {
      std::array<char, 40> text{};
      std::snprintf(text.data(), text.size(), "%.12g", shown.camera.eye[axis]);
      EXPECT_GE(room, ImGui::CalcTextSize(text.data()).x) << name << ": " << text.data();
    }
  }
}

TEST(PanelsTest, GlassObjectsKeepTheirBit) {
  GuiDriver gui(1280, 720);
  gui.document = document_of(3);
  gui.document.materials[2].mask_bit = 1;
  for (const int object : {2, 0}) {
    gui.state.object = static_cast<std::uint32_t>(object);
    gui.click("##column", {object, "glass"});
    const Material& material = gui.document.materials[static_cast<std::size_t>(object)];
    EXPECT_EQ(material.flags, MATERIAL_DIELECTRIC);
    EXPECT_GT(material.ior, 1.0F);
  }
  EXPECT_EQ(gui.document.materials[0].mask_bit, 0U);
  EXPECT_EQ(gui.document.materials[2].mask_bit, 1U);
}

TEST(PanelsTest, LightsAreAddedAndRemoved) {
  GuiDriver gui(1280, 1600);
  gui.document = document_of(1);
  gui.click("##column", {"Lights"});
  gui.click("##column", {"add point light"});
  ASSERT_EQ(lights_of(gui.document).size(), 3U);
  EXPECT_EQ(lights_of(gui.document)[2].light.kind, LIGHT_POINT);
  EXPECT_EQ(gui.state.light, 2U);
  gui.click("##column", {2, "remove"});
  EXPECT_EQ(lights_of(gui.document).size(), 2U);
  for (const int light : {1, 0}) gui.click("##column", {light, "remove"});
  EXPECT_TRUE(lights_of(gui.document).empty());
  gui.click("##column", {"add sun"});
  EXPECT_NEAR(glm::length(lights_of(gui.document)[0].light.position), 1.0, 1e-9);
}

TEST(PanelsTest, QualityAndEnvironmentChangeTheSettings) {
  GuiDriver gui(1280, 1600);
  gui.document = document_of(1);
  for (const char* section : {"Quality", "Environment", "Statistics"}) gui.click("##column", {section});
  gui.click("##column", {"shadows"});
  EXPECT_FALSE(gui.document.request.settings.shadows);
  gui.click("##column", {"black"});
  EXPECT_EQ(gui.document.request.look.environment, "black");
  gui.click("##column", {"blend"});
  gui.click("##Combo", {"nearest"});
  EXPECT_EQ(gui.document.request.settings.blend, BLEND_NEAREST);
  gui.click("##column", {"view"});
  gui.click("##Combo", {"facing"});
  EXPECT_EQ(gui.document.mode, ViewMode::facing);
}

TEST(PanelsTest, ButtonsAskForWhatKeysDo) {
  GuiDriver gui(1280, 1600);
  gui.document = document_of(1);
  ASSERT_EQ(gui.click("##column", {"copy"}).commands.size(), 1U);
  EXPECT_EQ(gui.click("##column", {"copy"}).commands[0].action, Action::copy_command);
  gui.click("##column", {"Camera"});
  EXPECT_EQ(gui.click("##column", {"below"}).commands[0].action, Action::view_bottom);
  EXPECT_EQ(gui.click("##column", {"4"}).commands[0].action, Action::bookmark_set);
  gui.state.bookmarks[3] = gui.document.camera;
  const Requests requests = gui.click("##column", {"4"});
  EXPECT_EQ(requests.commands[0].action, Action::bookmark_go);
  EXPECT_EQ(requests.commands[0].digit, 4);
}

TEST(PanelsTest, TheSaveDialogAsksForThePicture) {
  GuiDriver gui(1280, 720);
  gui.document = document_of(1);
  gui.state.show_save = true;
  gui.state.save.output.path = "picture.txt";
  EXPECT_FALSE(gui.can_click("Save the picture", {"save"}));
  gui.state.save.output.path = "picture.exr";
  gui.click("Save the picture", {"4K"});
  gui.click("Save the picture", {"denoise"});
  const Requests requests = gui.click("Save the picture", {"save"});
  ASSERT_TRUE(requests.save.has_value());
  EXPECT_EQ(requests.save->output.path, "picture.exr");
  EXPECT_EQ(requests.save->view.width, 3840U);
  EXPECT_TRUE(requests.save->output.denoise.value_or(false));
  EXPECT_FALSE(gui.state.show_save);
}

TEST(PanelsTest, TheSheetDialogAsksForADrawing) {
  GuiDriver gui(1280, 1000);
  gui.document = document_of(1);
  for (const char* button : {"open", "save", "sheet", "record", "copy", "keys"})
    EXPECT_TRUE(gui.can_click("##column", {button})) << button;
  EXPECT_EQ(gui.click("##column", {"sheet"}).commands.front().action, Action::sheet);
  EXPECT_TRUE(apply({Action::sheet}, 1.5, gui.document, gui.state));
  gui.state.sheet.output.path = "sheet.jpg";
  EXPECT_FALSE(gui.can_click("Save a drawing to scale", {"save"})) << "the format cannot hold one";
  gui.state.sheet.output.path = "sheet.pdf";
  gui.click("Save a drawing to scale", {"ink"});
  const Requests requests = gui.click("Save a drawing to scale", {"save"});
  ASSERT_TRUE(requests.save.has_value());
  EXPECT_TRUE(requests.save->view.ink);
  const Request saved = saved_request(gui.document, *requests.save);
  EXPECT_EQ(saved.view.sheet, requests.save->view.sheet);
  EXPECT_FALSE(saved.view.eye) << "a drawing has its own camera";
  EXPECT_FALSE(gui.state.show_sheet);
}

TEST(PanelsTest, CamerasAndBookmarksAreSavedAsFiles) {
  const TempFolder folder;
  GuiDriver gui(1280, 720);
  gui.document = document_of(1);
  gui.state.show_save = true;
  gui.state.save.output.path = folder.path() / "camera.json";
  EXPECT_FALSE(gui.click("Save the picture", {"save"}).save.has_value());
  EXPECT_EQ(read_camera(folder.path() / "camera.json"), gui.document.camera);

  gui.state.bookmarks[1] = gui.state.bookmarks[4] = gui.document.camera;
  gui.state.bookmarks[4]->eye.x += 1.0;
  gui.state.show_record = true;
  gui.state.record.output.turntable = 0;
  gui.state.record.output.camera_path = folder.path() / "path.json";
  gui.click("Record", {"write the bookmarks there"});
  const CameraPath path = read_camera_path(folder.path() / "path.json");
  ASSERT_EQ(path.size(), 2U);
  EXPECT_EQ(path[1].camera, *gui.state.bookmarks[4]);

  gui.state.record.output.camera_path = folder.path() / "none" / "path.json";
  gui.click("Record", {"write the bookmarks there"});
  EXPECT_NE(gui.state.error.find("path.json"), std::string::npos);
}

TEST(PanelsTest, RecordingsNeedANumberInTheirName) {
  GuiDriver gui(1280, 720);
  gui.document = document_of(1);
  gui.state.show_record = true;
  gui.state.record.output.path = "frame.png";
  EXPECT_FALSE(gui.can_click("Record", {"record"}));
  gui.state.record.output.path = "frame.####.png";
  EXPECT_EQ(gui.click("Record", {"record"}).save->output.turntable, 120U);
}

TEST(PanelsTest, ErrorsStayUntilClosedAndWorkCanBeCancelled) {
  GuiDriver gui(1280, 720);
  const Work work{"reading", 0.5};
  gui.view.work = &work;
  EXPECT_TRUE(gui.click("##work", {"cancel"}).cancel);
  gui.state.error = "dragon.ply: found nothing, expected points";
  gui.state.show_save = true;
  gui.click("That did not work", {"close"});
  EXPECT_TRUE(gui.state.error.empty());
  gui.click("Save the picture", {"cancel"});
}

TEST(PanelsTest, RecentFilesAreOffered) {
  GuiDriver gui(1280, 720);
  gui.state.recent_files = {{"/data/dragon.ply"}, {"/data/a.ply", "/data/b.ply"}};
  EXPECT_EQ(gui.click("##welcome", {"/data/dragon.ply", "dragon.ply"}).open, SceneFiles{"/data/dragon.ply"});
  const ControlPath both = {"/data/a.ply\n/data/b.ply", "a.ply and 1 more"};
  EXPECT_EQ(gui.click("##welcome", both).open, (SceneFiles{"/data/a.ply", "/data/b.ply"}));
}

TEST(PanelsTest, TheOpenDialogHasTheKeyboardAndAdds) {
  GuiDriver gui(1280, 720);
  gui.state.show_open = true;
  gui.state.can_add = true;
  for (int i = 0; i < 3; ++i) gui.frame();
  ImGui::GetIO().AddInputCharacter('x');
  gui.frame();
  gui.frame();
  EXPECT_EQ(gui.state.open_path, "x");
  gui.click("Open", {"beside what is shown"});
  const Requests requests = gui.click("Open", {"open"});
  EXPECT_EQ(requests.open, SceneFiles{"x"});
  EXPECT_TRUE(requests.add);
  EXPECT_FALSE(gui.state.add) << "asked for once";
}

TEST(PanelsTest, NoticesEndAfterTheirTimeAndTheirWork) {
  GuiDriver gui(1280, 720);
  gui.document = document_of(1);
  const Work work{"reading", 0.5};
  gui.view.work = &work;
  gui.state.notice = "one thing";
  add_line(gui.state.notice, "another");
  add_line(gui.state.notice, "another");
  EXPECT_EQ(gui.state.notice, "one thing\nanother");
  ImGui::GetIO().DeltaTime = static_cast<float>(NOTICE_SECONDS);
  for (int i = 0; i < 5; ++i) gui.frame();
  EXPECT_FALSE(gui.state.notice.empty()) << "the work goes on";
  gui.view.work = nullptr;
  for (int i = 0; i < 3; ++i) gui.frame();
  EXPECT_TRUE(gui.state.notice.empty());
}

TEST(PanelsTest, EscapeClosesADropDownList) {
  GuiDriver gui(1280, 720);
  gui.document = document_of(1);
  EXPECT_FALSE(close_drop_down());
  gui.click("##column", {"Statistics"});
  gui.click("##column", {"view"});
  EXPECT_GT(gui.rectangle("##Combo").GetArea(), 0.0F);
  EXPECT_TRUE(close_drop_down());
  for (int i = 0; i < 2; ++i) gui.frame();
  EXPECT_EQ(gui.rectangle("##Combo").GetArea(), 0.0F);
  gui.state.show_save = true;
  for (int i = 0; i < 3; ++i) gui.frame();
  EXPECT_FALSE(close_drop_down()) << "dialogs are closed otherwise";
}

TEST(PanelsTest, NothingOverlapsAndThePictureIsTheMainThing) {
  for (const glm::vec2& size : {glm::vec2(1280, 720), glm::vec2(1920, 1080)}) {
    GuiDriver gui(size.x, size.y);
    gui.document = document_of(2);
    gui.document.mode = ViewMode::tests;
    const Frame frame = some_frame(ViewMode::tests);
    const Work work{"saving", 0.5};
    gui.view = {&frame, nullptr, 17.0, &work};
    for (int i = 0; i < 3; ++i) gui.frame();
    const std::vector<std::string> windows = {"##column", "##status", "##legend", "##work"};
    for (const std::string& a : windows) {
      EXPECT_GT(gui.rectangle(a).GetArea(), 0.0F) << a;
      for (const std::string& b : windows)
        EXPECT_EQ(gui.rectangle(a).Overlaps(gui.rectangle(b)), a == b) << a << b;
    }
    EXPECT_EQ(gui.rectangle("##column").GetWidth(), panel_column_px(gui.state, size.x));
    EXPECT_LT(panel_column_px(gui.state, size.x), 0.25F * size.x);
    gui.state.show_panels = false;
    EXPECT_EQ(panel_column_px(gui.state, size.x), 0.0F);
  }
}

}  // namespace
}  // namespace splatray
