// Regions taken hold of, slices, measures, undo, turning about a point, walking, and folders.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "app/view/model/folder_listing.h"
#include "app/view/model/history.h"
#include "app/view/model/navigation.h"
#include "app/view/model/region_edit.h"
#include "app/view/model/section_sheet.h"
#include "tests/temp_folder.h"
#include "tests/view/documents.h"
#include "tests/view/gui_driver.h"

namespace splatray {
namespace {

constexpr glm::dvec2 PICTURE(800.0, 600.0);

class RegionEdit : public ::testing::TestWithParam<NamedDocument> {
 protected:
  Document document = GetParam().document;
  double size = 2.0 * scene_radius_world(document);
};

/// The handle of this number moves as far as the cursor, and all other faces stay.
TEST_P(RegionEdit, AFaceFollowsTheCursorAndTheOthersStay) {
  for (const double turn : {0.0, 30.0})
    for (std::size_t number = 0; number < 6; ++number)
      for (const bool ortho : {false, true}) {
        document = GetParam().document;
        if (ortho) toggle_orthographic(document);
        document.request.view.region.keep_box = box_of_all(document);
        document.request.view.region.keep_box->turn_deg = turn;
        const std::vector<Grip> before = handles_of(document);
        const Grip& grip = before[number];
        const glm::dvec3 wanted = grip.place_world + 0.1 * size * grip.normal;
        const auto from = place_in_picture(document.camera, grip.place_world, PICTURE);
        const auto to = place_in_picture(document.camera, wanted, PICTURE);
        ASSERT_TRUE(from && to);
        if (glm::distance(*from, *to) < 5.0) continue;  // looked at from its end
        EXPECT_EQ(handle_at(document, *from + glm::dvec2(2.0, 0.0), PICTURE, 6.0).value_or(Grip{}).number,
                  number);
        drag_handle(document, grip, *from, *to, PICTURE);
        const std::vector<Grip> after = handles_of(document);
        for (std::size_t i = 0; i < 6; ++i) {
          const double moved = glm::dot(after[i].place_world - before[i].place_world, before[i].normal);
          EXPECT_NEAR(moved, i == number ? 0.1 * size : 0.0, 2e-3 * size)
              << i << " of " << number << " turned " << turn;
        }
      }
}

TEST_P(RegionEdit, ABoxIsNeverTurnedInsideOut) {
  document.request.view.region.keep_box = box_of_all(document);
  for (std::size_t number = 0; number < 6; ++number) {
    Grip grip = handles_of(document)[number];
    for (const double far : {-1e3, 1e3})
      drag_handle(document, grip, {400, 300}, {400 + far, 300 - far}, PICTURE);
  }
  EXPECT_TRUE(glm::all(glm::lessThan(document.request.view.region.keep_box->low,
                                     document.request.view.region.keep_box->high)));
}

TEST_P(RegionEdit, ASliceMovesAndKeepsItsThickness) {
  document.request.view.region.cuts = {{document.bounds_min_world, {1.0, 1.0, 0.0}}};
  EXPECT_FALSE(slice_of(document.request.view.region));
  for (int axis = 0; axis < 3; ++axis) {
    const Slice first = first_slice(document, axis);
    set_slice(document.request.view.region, first);
    ASSERT_EQ(document.request.view.region.cuts.size(), 3U) << "one slice, beside the plane";
    const Slice slice = slice_of(document.request.view.region).value();
    EXPECT_NEAR(slice.thickness, first.thickness, 1e-6 * size);
    for (int i = 0; i < 7; ++i) EXPECT_TRUE(move_slice(document, 1.0));
    const Slice moved = slice_of(document.request.view.region).value();
    EXPECT_NEAR(glm::dot(moved.point - slice.point, slice.normal), 0.035 * size, 1e-6 * size);
    EXPECT_NEAR(moved.thickness, first.thickness, 1e-6 * size);
  }
  remove_slice(document.request.view.region);
  remove_slice(document.request.view.region);
  EXPECT_EQ(document.request.view.region.cuts.size(), 1U);
  EXPECT_FALSE(move_slice(document, 1.0));
}

/// A point beside the middle of the picture stays where it is in it, and as far from the eye.
TEST_P(RegionEdit, TurningAboutAPointKeepsItInItsPlace) {
  const glm::dvec3 about = point_under(document.camera, {620.0, 140.0}, PICTURE);
  const double before = glm::distance(about, document.camera.eye);
  const Camera camera = document.camera;
  for (const glm::dvec2& drag : {glm::dvec2(40.0, 10.0), glm::dvec2(-90.0, 35.0), glm::dvec2(3.0, -20.0)}) {
    orbit(document, drag, PICTURE, about);
    const auto place = place_in_picture(document.camera, about, PICTURE);
    ASSERT_TRUE(place);
    EXPECT_LT(glm::distance(*place, glm::dvec2(620.0, 140.0)), 0.05);
  }
  EXPECT_NEAR(glm::distance(about, document.camera.eye), before, 1e-6 * before);
  EXPECT_GT(glm::distance(document.camera.target, camera.target), 1e-3 * size);
}

TEST_P(RegionEdit, PlacesInThePictureAreWhereTheyAreSeen) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> share(-0.5, 0.5);
  for (int i = 0; i < 20; ++i) {
    if (i == 10) toggle_orthographic(document);
    const glm::dvec3 point =
        document.camera.target + size * glm::dvec3(share(random), share(random), share(random));
    const auto place = place_in_picture(document.camera, point, PICTURE);
    ASSERT_TRUE(place);
    EXPECT_LT(glm::distance(*place, projected(document.camera, point, PICTURE)), 0.05);
  }
  EXPECT_FALSE(
      place_in_picture(document.camera, 2.0 * document.camera.eye - document.camera.target, PICTURE));
}

TEST_P(RegionEdit, WalkingStaysLevelWhereverOneLooks) {
  orbit(document, {0.0, 120.0}, PICTURE);  // looks down
  const glm::dvec3 up = glm::normalize(up_of(document)), eye = document.camera.eye;
  walk(document, {0.0, 0.0, 1.0}, 0.2, 2.0);
  EXPECT_NEAR(glm::dot(document.camera.eye - eye, up), 0.0, 1e-6 * size);
  EXPECT_NEAR(glm::distance(document.camera.eye, eye), 0.02 * size, 1e-6 * size)
      << "twice a tenth of the radius a second";
  walk(document, {0.0, 1.0, 0.0}, 0.2, 2.0);
  EXPECT_NEAR(glm::dot(document.camera.eye - eye, up), 0.02 * size, 1e-6 * size);
}

INSTANTIATE_TEST_SUITE_P(Documents, RegionEdit, ::testing::ValuesIn([] {
                           std::vector<NamedDocument> documents = navigated_documents();
                           std::erase_if(documents,
                                         [](const NamedDocument& one) { return one.name == "one point"; });
                           return documents;
                         }()));

/// A box of 2 about (1, 2, 3), y up, whose plan's north is -z.
class SectionSheet : public ::testing::Test {
 protected:
  std::string sheet() { return sheet_text(section_sheet(document, {})); }

  Document document = box_document({1.0, 2.0, 3.0}, 2.0);
};

TEST_F(SectionSheet, FromAboveItIsAPlanAtTheLowestCut) {
  set_axis_view(document, AxisView::top);
  EXPECT_EQ(sheet(), "plan");
  set_slice(document.request.view.region, {{0.0, 2.5, 0.0}, {0.0, 1.0, 0.0}, 0.5});
  EXPECT_EQ(sheet(), "plan:z=2.75");
  document.request.view.region.keep_box = TurnedBox{{0.0, 0.0, 0.0}, {9.0, 2.25, 9.0}, 30.0};
  EXPECT_EQ(sheet(), "plan:z=2.25");
  document.request.view.region.keep_box->high.y = 99.0;                      // above all there is
  document.request.view.region.cuts = {{{0.0, 1.5, 0.0}, {0.0, 1.0, 0.0}}};  // from below
  EXPECT_EQ(sheet(), "plan");
  set_axis_view(document, AxisView::bottom);
  EXPECT_EQ(sheet(), "ortho:0,1,0");
}

TEST_F(SectionSheet, LevelItIsASectionAlongTheCutThatIsSeen) {
  set_axis_view(document, AxisView::front);
  EXPECT_EQ(sheet(), "elevation:180") << "from the south";
  set_slice(document.request.view.region, {{0.0, 2.0, 0.0}, {0.0, 1.0, 0.0}, 0.5});
  EXPECT_EQ(sheet(), "elevation:180") << "a level slice is none";
  set_slice(document.request.view.region, {{0.0, 0.0, 3.0}, {0.0, 0.0, 1.0}, 0.5});
  const SheetRequest section = section_sheet(document, {});
  ASSERT_EQ(section.kind, SheetKind::section);
  // Looking along -z to the left of a line that goes along x: at the slice's near side, z = 3.25.
  EXPECT_NEAR(section.place[1], -3.25, 1e-9);
  EXPECT_NEAR(section.place[3], -3.25, 1e-9);
  EXPECT_LT(section.place[0], 0.0);
  EXPECT_GT(section.place[2], 2.0);
  document.request.view.region.keep_box = TurnedBox{{0.5, 0.0, 0.0}, {1.5, 9.0, 9.0}};
  const SheetRequest boxed = section_sheet(document, {});
  EXPECT_NEAR(boxed.place[0], 0.5, 1e-9);
  EXPECT_NEAR(boxed.place[2], 1.5, 1e-9);
  set_axis_view(document, AxisView::back);
  EXPECT_NEAR(section_sheet(document, {}).place[1], -2.75, 1e-9) << "the slice's other side";
  document.request.view.region = {};
  set_axis_view(document, AxisView::right);
  EXPECT_EQ(sheet(), "elevation:90");
  orbit(document, {40.0, 0.0}, PICTURE);
  EXPECT_EQ(sheet(), "elevation:90") << "the nearest side";
}

TEST_F(SectionSheet, KeepsScaleDpiWeightAndUnit) {
  const SheetRequest like = read_sheet("section:0,0,1,0,scale=20,dpi=100,weight=0.5,unit=mm,depth=2");
  set_axis_view(document, AxisView::top);
  EXPECT_EQ(sheet_text(section_sheet(document, like)), "plan:depth=2,scale=20,dpi=100,weight=0.5,unit=0.001");
  EXPECT_EQ(sheet_sentence(read_sheet("plan:z=1.25")), "A plan, cut at the height 1.25.");
  EXPECT_EQ(sheet_sentence(read_sheet("elevation:west")), "An elevation, seen from the west.");
}

TEST(HistoryTest, StepsBackAndForthWithoutTheCamera) {
  Document document = box_document({0, 0, 0}, 2.0);
  History history;
  history.start(document);
  EXPECT_FALSE(history.undo(document));
  document.request.look.exposure_ev = 1.0;
  history.see(document, true);
  document.request.look.exposure_ev = 2.0;
  history.see(document, false);  // a drag is one step
  document.camera.eye.x += 1.0;
  history.see(document, false);
  document.measures.push_back({MeasureKind::distance, {{{1, 2, 3}}}});
  history.see(document, false);
  const Camera camera = document.camera;
  EXPECT_TRUE(history.undo(document));
  EXPECT_TRUE(document.measures.empty());
  EXPECT_EQ(exposure_of(document), 2.0);
  history.see(document, false);  // as each frame does
  EXPECT_TRUE(history.undo(document));
  EXPECT_EQ(exposure_of(document), 0.0);
  EXPECT_EQ(document.camera, camera) << "it is not moved";
  EXPECT_FALSE(history.undo(document));
  EXPECT_TRUE(history.redo(document));
  EXPECT_TRUE(history.redo(document));
  EXPECT_FALSE(history.redo(document));
  EXPECT_EQ(document.measures.size(), 1U);
  EXPECT_TRUE(history.undo(document));
  document.request.view.region.light_kept = true;
  history.see(document, false);
  EXPECT_FALSE(history.redo(document)) << "another way was taken";
  for (std::size_t i = 0; i < 2 * History::MOST; ++i) {
    document.request.look.exposure_ev = exposure_of(document) + 1.0;
    history.see(document, false);
  }
  std::size_t steps = 0;
  while (history.undo(document)) ++steps;
  EXPECT_EQ(steps, History::MOST - 1);
}

TEST(FolderListingTest, ShowsFoldersAndWhatCanBeOpened) {
  const TempFolder folder;
  for (const char* name : {"b.laz", "a.PLY", "c.soct", "notes.doc", ".hidden.ply", "zoo/x.ply"})
    folder.write(name, "12345");
  const FolderListing listing = list_folder(folder.path());
  ASSERT_EQ(listing.entries.size(), 4U);
  EXPECT_TRUE(listing.entries[0].is_folder && listing.entries[0].name == "zoo");
  EXPECT_EQ(listing.entries[1].name, "a.PLY");
  EXPECT_EQ(listing.entries[1].bytes, 5U);
  EXPECT_EQ(listing.error, "");
  EXPECT_NE(list_folder(folder.path() / "none").error, "");
  EXPECT_EQ(size_text(5), "0.0 kB");
  EXPECT_EQ(size_text(9664413), "9.7 MB");
  EXPECT_EQ(size_text(12'000'000'000), "12 GB");
}

class EditPanels : public ::testing::Test {
 protected:
  void SetUp() override {
    gui.document = box_document({1.0, 2.0, 3.0}, 2.0);
    gui.document.materials.resize(1);
    LoadedPart loaded;
    loaded.materials = gui.document.materials;
    loaded.object_names = {"scan"};
    loaded.is_scan = true;
    gui.document.loaded = std::make_shared<const LoadedPart>(std::move(loaded));
    gui.view.picture_px = {980, 1600};
  }

  GuiDriver gui{1280, 1600};
};

TEST_F(EditPanels, RegionsAreSwitchedOnAndOff) {
  gui.click("##column", {"look in"});
  EXPECT_TRUE(gui.document.request.view.look_in);
  gui.click("##column", {"keep a box", "keep a box"});
  ASSERT_TRUE(gui.document.request.view.region.keep_box);
  gui.click("##column", {"level"});
  ASSERT_TRUE(slice_of(gui.document.request.view.region));
  EXPECT_EQ(slice_of(gui.document.request.view.region)->normal, glm::dvec3(0.0, 1.0, 0.0));
  gui.click("##column", {"plane across the view"});
  ASSERT_EQ(gui.document.request.view.region.cuts.size(), 3U);
  EXPECT_TRUE(slice_of(gui.document.request.view.region)) << "the slice stays the last";
  const glm::dvec3 normal = gui.document.request.view.region.cuts[0].normal;
  gui.click("##column", {0, "flip"});
  EXPECT_EQ(gui.document.request.view.region.cuts[0].normal, -normal);
  gui.click("##column", {0, "remove"});
  EXPECT_EQ(gui.document.request.view.region.cuts.size(), 2U);
  gui.click("##column", {"none"});
  EXPECT_TRUE(gui.document.request.view.region.cuts.empty());
  gui.click("##column", {"light of what is kept alone"});
  gui.click("##column", {"show all of it"});
  EXPECT_EQ(gui.document.request.view.region, RegionRequest{});
}

TEST_F(EditPanels, MeasuresAreListedAndCopied) {
  gui.click("##column", {"vertical"});
  EXPECT_EQ(gui.state.measuring, MeasureKind::vertical);
  gui.document.measures = {{MeasureKind::distance, {{{1, 2, 3}}, {{1, 2, 5}}}},
                           {MeasureKind::area, {{{1, 2, 3}}}}};
  gui.click("##column", {"copy all"});
  EXPECT_NE(std::string(ImGui::GetClipboardText()).find("distance\t2\t\tm"), std::string::npos)
      << ImGui::GetClipboardText();
  gui.click("##column", {0, "remove"});
  ASSERT_EQ(gui.document.measures.size(), 1U);
  EXPECT_EQ(gui.document.measures[0].kind, MeasureKind::area);
  gui.click("##column", {"remove all"});
  EXPECT_TRUE(gui.document.measures.empty());
}

TEST_F(EditPanels, MarksAreDrawnWhateverIsThere) {
  gui.document.request.view.region.keep_box = box_of_all(gui.document);
  gui.document.request.view.region.drop_box = gui.document.request.view.region.keep_box;
  set_slice(gui.document.request.view.region, first_slice(gui.document, 1));
  gui.document.measures = {{MeasureKind::area, {{{1, 2, 3}}, {{1, 2, 4}}, {{2, 2, 3}}}},
                           {MeasureKind::angle, {}}};
  gui.view.about_world = gui.document.camera.target;
  const auto vertices = [this] {
    gui.frame();
    return ImGui::GetDrawData()->TotalVtxCount;
  };
  const int with = vertices();
  gui.document.measures.clear();
  EXPECT_LT(vertices(), with);
  gui.document.camera.eye = gui.document.camera.target + glm::dvec3(0.0, 0.0, 1e-3);  // within all of it
  EXPECT_GT(vertices(), 0);
  gui.view.picture_px = {0, 0};
  EXPECT_GT(vertices(), 0);
}

TEST_F(EditPanels, TheOpenDialogEntersFoldersAndTakesSeveralFiles) {
  const TempFolder folder;
  for (const char* name : {"a.ply", "deep/b.laz", "deep/c.laz"}) folder.write(name, "x");
  gui.state.recent_files = {{folder.path() / "a.ply"}};
  gui.state.show_open = true;
  gui.click("/files", {"deep/"});
  ASSERT_TRUE(gui.state.open_listing);
  EXPECT_EQ(gui.state.open_listing->folder, folder.path() / "deep");
  gui.click("/files", {"c.laz"});
  gui.click("/files", {"b.laz"});
  gui.click("/files", {"c.laz"});
  ASSERT_EQ(gui.state.open_chosen.size(), 1U) << "chosen, and no longer";
  gui.click("/files", {"c.laz"});
  EXPECT_EQ(gui.click("Open", {"open"}).open,
            (SceneFiles{folder.path() / "deep/b.laz", folder.path() / "deep/c.laz"}));
  EXPECT_FALSE(gui.state.show_open);
  gui.state.show_open = true;
  gui.frame();
  gui.frame();
  EXPECT_EQ(gui.state.open_listing->folder, folder.path()) << "again where files were opened last";
  EXPECT_EQ(gui.click("Open", {"all scans of this folder"}).open, SceneFiles{folder.path()});
}

}  // namespace
}  // namespace splatray
