// Several sheets in one file: the floors of a house, and views on a page.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>

#include "app/library/cut/curve_window.h"
#include "app/library/cut/floor_levels.h"
#include "app/library/request/consistent.h"
#include "app/library/sheet/sheet_dxf.h"
#include "app/library/sheet/sheet_page.h"
#include "app/library/sheet/text_block.h"
#include "app/library/shot/sheet_set.h"
#include "engine/base/error.h"
#include "engine/base/number_text.h"
#include "preprocess/build.h"
#include "tests/sheet/sheet_of_ball.h"

namespace splatray {
namespace {

using testing::ball, testing::with_sheet;

constexpr double BASE = 100.3, STOREY = 3.1, ROOM = 2.8, POINT_SPACING = 0.1;
const glm::dvec3 UP(0.0, 0.0, 1.0);

/// Rooms one above the other, each narrower than the one below and with a table, of points with noise.
class House {
 public:
  House(int storeys, double noise) : noise_(noise) {
    for (int i = 0; i < storeys; ++i) add_room(6.0 - 0.5 * i, BASE + STOREY * i);
  }
  /// The ground of a hillside.
  static Input hill() {
    House hill(0, 0.0);
    hill.add_rect({0.0, 0.0, 0.0}, {40.0, 0.0, 4.0}, {0.0, 10.0, 1.0}, UP, 0.2);
    return std::move(hill.input_);
  }
  Input input_;

 private:
  void add_room(double width, double floor) {
    const glm::dvec3 x(width, 0.0, 0.0), y(0.0, 4.0, 0.0), z(0.0, 0.0, ROOM), low(0.0, 0.0, floor);
    add_rect(low, x, y, UP);
    add_rect(low + z, x, y, -UP);
    add_rect(low, x, z, {0.0, 1.0, 0.0});
    add_rect(low + y, x, z, {0.0, -1.0, 0.0});
    add_rect(low, y, z, {1.0, 0.0, 0.0});
    add_rect(low + x, y, z, {-1.0, 0.0, 0.0});
    add_rect(low + glm::dvec3(1.0, 1.0, 0.75), {2.5, 0.0, 0.0}, {0.0, 1.5, 0.0}, UP);
  }
  void add_rect(const glm::dvec3& corner, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& front,
                double spacing = POINT_SPACING) {
    if (input_.objects.empty()) input_.objects.emplace_back();
    Points& points = input_.objects.front().points;
    const double length_a = glm::length(a), length_b = glm::length(b);
    for (double u = 0.5 * spacing; u < length_a; u += spacing)
      for (double v = 0.5 * spacing; v < length_b; v += spacing) {
        points.position.push_back(corner + u / length_a * a + v / length_b * b +
                                  std::normal_distribution(0.0, 1.0)(random_) * noise_ * front);
        points.normal.emplace_back(front);
      }
  }

  double noise_;
  std::mt19937 random_{3};
};

Scene scene_of_input(Input input) {
  BuildStats stats;
  Scene scene = build_scene(std::move(input), {}, 0, stats);
  scene.up = UP;
  return scene;
}

Scene house(int storeys, double noise = 0.001) { return scene_of_input(House(storeys, noise).input_); }

std::vector<double> floors_of(const Scene& scene, double metres = 1.0) {
  return storey_floors(scene, {}, UP, metres, 1.2 / metres);
}

TEST(StoreyFloors, AreThoseOfAHouse) {
  for (const auto& [storeys, noise] : {std::pair(1, 0.001), {8, 0.001}, {3, 0.02}}) {
    const std::vector<double> floors = floors_of(house(storeys, noise));
    ASSERT_EQ(floors.size(), static_cast<std::size_t>(storeys)) << noise;
    for (std::size_t i = 0; i < floors.size(); ++i)
      EXPECT_NEAR(floors[i], BASE + STOREY * static_cast<double>(i), 0.002 + 0.2 * noise) << noise;
  }
}

TEST(StoreyFloors, AreNeitherSlopesNorUndersides) {
  EXPECT_TRUE(floors_of(scene_of_input(House::hill())).empty());
  Input upside_down = House(2, 0.001).input_;
  for (glm::vec3& normal : upside_down.objects.front().points.normal) normal = -normal;
  const std::vector<double> ceilings = floors_of(scene_of_input(std::move(upside_down)));
  for (const double height : ceilings) EXPECT_GT(height, BASE + 2.0) << "floors face down";
}

TEST(StoreyFloors, HaveTheUnitOfTheFile) {
  Input feet = House(2, 0.001).input_;
  for (glm::dvec3& place : feet.objects.front().points.position) place /= 0.3048;
  const std::vector<double> floors = floors_of(scene_of_input(std::move(feet)), 0.3048);
  ASSERT_EQ(floors.size(), 2U);
  EXPECT_NEAR(floors[1] * 0.3048, BASE + STOREY, 0.003);
}

bool has_text(const Drawing& page, const std::string& text) {
  return std::any_of(page.texts.begin(), page.texts.end(),
                     [&](const DrawnText& drawn) { return drawn.text == text; });
}

TEST(Atlas, HasAPageForEachFloorInOneFrame) {
  const SheetSet atlas = make_sheet_set(house(3), with_sheet("atlas:scale=100,dpi=100"));
  ASSERT_TRUE(atlas.is_atlas);
  ASSERT_EQ(atlas.sheets.size(), 3U);
  const std::vector<Drawing> pages = sheet_pages(atlas, {"House", {}}, {});
  ASSERT_EQ(pages.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    const Sheet &sheet = atlas.sheets[i], &first = atlas.sheets[0];
    EXPECT_LT(number_text(*sheet.asked.height).size(), 8U) << "a round number";
    EXPECT_NEAR(*sheet.asked.height, BASE + STOREY * static_cast<double>(i) + 1.2, 0.003);
    EXPECT_EQ(sheet.corner, first.corner);
    EXPECT_EQ(glm::uvec2(sheet.width, sheet.height), glm::uvec2(first.width, first.height));
    EXPECT_EQ(pages[i].size, pages[0].size);
    EXPECT_EQ(pages[i].rasters.front().corner, pages[0].rasters.front().corner);
    EXPECT_TRUE(has_text(pages[i], std::to_string(i + 1) + "/3"));
    EXPECT_FALSE(sheet.cut_curves.empty());
  }
  EXPECT_TRUE(has_text(pages[1], "House, floor at height 103.40 m"));
  EXPECT_NEAR(*make_sheet_set(house(1), with_sheet("atlas:above=0.5,scale=100")).sheets.at(0).asked.height,
              BASE + 0.5, 0.003);
}

TEST(Atlas, OfNoFloorIsRefused) {
  try {
    (void)make_sheet_set(scene_of_input(House::hill()), with_sheet("atlas:scale=100"));
    FAIL() << "a hillside has no floor";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    EXPECT_EQ(std::string(error.what()).rfind("found no floor", 0), 0U) << error.what();
  }
}

TEST(Atlas, HasMeasuresOnTheirFloors) {
  const SheetSet atlas = make_sheet_set(house(3), with_sheet("atlas:scale=100,dpi=100"));
  const auto at = [](double height) {
    return Measure{MeasureKind::distance, {{{1.0, 1.0, height}}, {{3.0, 1.0, height}}}};
  };
  const std::vector<Measure> measures = {at(BASE - 0.4), at(BASE + STOREY - 0.05),
                                         at(BASE + 2.0 * STOREY + 9.0)};
  const std::vector<Drawing> pages = sheet_pages(atlas, {}, measures);
  for (std::size_t page = 0; page < 3; ++page)
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_EQ(has_text(pages[page], std::to_string(i + 1) + ": 2 m"), page == i) << page << " " << i;
}

TEST(Atlas, HasLayersForEachFloorInDxf) {
  const SheetSet atlas = make_sheet_set(house(2), with_sheet("atlas:scale=100,dpi=100"));
  const std::string dxf = sheets_dxf(atlas, {"House", {}}, {});
  for (const char* layer : {"\n8\nFLOOR1-CUT\n", "\n8\nFLOOR2-CUT\n", "\n8\nFLOOR2-TEXT\n"})
    EXPECT_NE(dxf.find(layer), std::string::npos) << layer;
  EXPECT_EQ(dxf.find("\n8\nCUT\n"), std::string::npos);
}

TEST(Views, LieInOneScaleWithWallsAndFloorsInLine) {
  const SheetSet set = make_sheet_set(
      house(2),
      with_sheet("plan:z=101.5,scale=100,dpi=100,level=100.3;section:0,2,6,2;elevation:south;plan:z=104.6"));
  ASSERT_EQ(set.sheets.size(), 4U);
  for (const Sheet& sheet : set.sheets) EXPECT_EQ(sheet.pixel_world, set.sheets[0].pixel_world);
  const std::vector<Drawing> pages = sheet_pages(set, {"House", {}}, {});
  ASSERT_EQ(pages.size(), 1U);
  const std::vector<DrawnRaster>& pictures = pages[0].rasters;
  ASSERT_EQ(pictures.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const TextBox a{pictures[i].corner, pictures[i].corner + pictures[i].size};
      const TextBox b{pictures[j].corner, pictures[j].corner + pictures[j].size};
      EXPECT_FALSE(a.meets(b)) << i << " covers " << j;
      const bool in_column = a.low.x == b.low.x, in_row = std::abs(a.high.y - b.high.y) < 1e-9;
      EXPECT_TRUE(in_column || in_row || i + j == 3U) << i << " " << j;
    }
  EXPECT_TRUE(has_text(pages[0], "3 Elevation from the south") ||
              has_text(pages[0], "3  Elevation from the south"));
  const std::string dxf = sheets_dxf(set, {"House", {}}, {});
  for (const char* caption : {"1  Plan, cut at height 101.5", "2  Section", "3  Elevation", "4  Plan"})
    EXPECT_NE(dxf.find(caption), std::string::npos) << caption;
}

TEST(Views, ShowEachMeasureWhereItIsLongest) {
  const SheetSet set =
      make_sheet_set(house(1), with_sheet("plan:z=101.5,scale=50,dpi=100;section:0,2,6,2;elevation:south"));
  const auto line = [](const glm::dvec3& from, const glm::dvec3& to) {
    return Measure{MeasureKind::distance, {{from}, {to}}};
  };
  const std::vector<Measure> measures = {line({1.0, 2.0, BASE + 1.0}, {3.0, 2.0, BASE + 1.0}),
                                         line({2.0, 3.0, BASE}, {2.0, 3.0, BASE + 2.5}),
                                         line({2.0, 3.0, BASE}, {99.0, 3.0, BASE})};
  for (std::size_t view = 0; view < 3; ++view) {
    const std::vector<Measure> shown = measures_of_sheet(set, view, measures);
    EXPECT_EQ(!shown[0].points.empty(), view == 0) << "level, as long in all: in the plan";
    EXPECT_EQ(!shown[1].points.empty(), view == 1) << "upright: in the section";
    EXPECT_TRUE(shown[2].points.empty()) << "leaves all views";
  }
}

TEST(CurveWithin, IsWhatARectangleShows) {
  const CutCurve square{{{0.0, 0.0}, {2.0, 0.0}, {2.0, 2.0}, {0.0, 2.0}}, true, 0.1};
  const std::vector<CutCurve> whole = curve_within(square, {-1.0, -1.0}, {3.0, 3.0});
  ASSERT_EQ(whole.size(), 1U);
  EXPECT_TRUE(whole[0].closed);
  const std::vector<CutCurve> left = curve_within(square, {-1.0, -1.0}, {1.0, 3.0});
  ASSERT_EQ(left.size(), 1U) << "one part around the curve's beginning";
  EXPECT_EQ(left[0].points, (std::vector<glm::dvec2>{{1.0, 2.0}, {0.0, 2.0}, {0.0, 0.0}, {1.0, 0.0}}));
  const std::vector<CutCurve> middle = curve_within(square, {0.5, -1.0}, {1.5, 3.0});
  ASSERT_EQ(middle.size(), 2U);
  EXPECT_EQ(middle[0].points, (std::vector<glm::dvec2>{{0.5, 0.0}, {1.5, 0.0}}));
  EXPECT_TRUE(curve_within(square, {0.5, 0.5}, {1.5, 1.5}).empty());
}

TEST(Views, TakePaperThatHoldsThem) {
  const Scene scene = house(1);
  const std::string sheet = "plan:scale=50,dpi=20,paper=";
  EXPECT_THROW((void)sheet_pages(make_sheet_set(scene, with_sheet(sheet + "A4;plan;plan;plan")), {}, {}),
               Error);
  EXPECT_EQ(sheet_pages(make_sheet_set(scene, with_sheet(sheet + "A2;plan;plan;plan")), {}, {}).at(0).size,
            glm::dvec2(594.0, 420.0));
}

TEST(SheetSetRequest, IsOfPagesAlone) {
  const auto refuses = [](const std::string& sheet, const std::string& output, std::vector<FieldText> more) {
    Request request;
    std::vector<FieldText> fields = {{"sheet", sheet}, {"output", output}};
    fields.insert(fields.end(), more.begin(), more.end());
    assign(request, fields, DOOR_RENDER);
    try {
      require_consistent(request);
      return false;
    } catch (const Error&) {
      return true;
    }
  };
  EXPECT_FALSE(refuses("atlas", "a.pdf", {}));
  EXPECT_FALSE(refuses("plan;plan:z=1", "a.svg", {}));
  EXPECT_TRUE(refuses("atlas", "a.svg", {}));
  EXPECT_TRUE(refuses("plan;plan:z=1", "a.png", {}));
  EXPECT_TRUE(refuses("atlas", "a.pdf", {{"tile", "1/2"}}));
}

}  // namespace
}  // namespace splatray
