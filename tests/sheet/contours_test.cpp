// Contours and levels of surfaces of known heights.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "app/library/cut/contours.h"
#include "app/library/cut/floor_levels.h"
#include "app/library/sheet/height_marks.h"
#include "app/library/sheet/page_style.h"
#include "app/library/sheet/sheet_dxf.h"
#include "app/library/sheet/sheet_page.h"
#include "app/library/sheet/text_block.h"
#include "app/library/shot/picture_notes.h"
#include "app/library/shot/sheet_placement.h"
#include "engine/base/error.h"
#include "preprocess/build.h"
#include "tests/sheet/sheet_of_ball.h"

namespace splatray {
namespace {

using testing::with_sheet;

/// Heights of a function of the place, a cell being 0.01.
template <typename Height>
HeightRaster raster_of(const Height& height) {
  HeightRaster raster{{0.0, 2.0}, 0.01, 300, 200, {}};
  for (std::uint32_t row = 0; row < raster.height; ++row)
    for (std::uint32_t column = 0; column < raster.width; ++column)
      raster.values.push_back(height(raster.corner + glm::dvec2(column + 0.5, -(row + 0.5)) * raster.cell));
  return raster;
}

double length_of(const CutCurve& curve) {
  double length = 0.0;
  for (std::size_t i = curve.closed ? 0 : 1; i < curve.points.size(); ++i)
    length +=
        glm::distance(curve.points[(i + curve.points.size() - 1) % curve.points.size()], curve.points[i]);
  return length;
}

TEST(Contours, OfAConeAreItsCircles) {
  const glm::dvec2 top(1.5, 1.0);
  const auto contours =
      contours_of(raster_of([&](const glm::dvec2& at) { return 5.0 - glm::distance(at, top); }), 0.25, 1.0);
  std::size_t closed = 0;
  for (const Contour& contour : contours) {
    const double radius = 5.0 - contour.height;
    EXPECT_NEAR(std::remainder(contour.height, 0.25), 0.0, 1e-12);
    for (const glm::dvec2& point : contour.curve.points)
      ASSERT_NEAR(glm::distance(point, top), radius, 5e-4) << contour.height;
    if (!contour.curve.closed) continue;
    ++closed;
    EXPECT_NEAR(length_of(contour.curve), 2.0 * std::numbers::pi * radius, 0.01 * radius);
    const glm::dvec2 along = contour.curve.points[1] - contour.curve.points[0],
                     to = top - contour.curve.points[0];
    EXPECT_LT(along.x * to.y - along.y * to.x, 0.0) << "the higher side is to the right";
  }
  EXPECT_EQ(closed, 3U) << "of 0.25, 0.5 and 0.75 around the top; others leave the raster";
}

TEST(Contours, GoRoundSaddlesHolesAndSteps) {
  const auto saddle = [](const glm::dvec2& at) { return (at.x - 1.503) * (at.y - 1.002); };
  double length = 0.0;
  for (const Contour& contour : contours_of(raster_of(saddle), 10.0, 1.0)) length += length_of(contour.curve);
  EXPECT_NEAR(length, 5.0, 0.05) << "two lines that cross, of height 0";
  const auto cliff = [](const glm::dvec2& at) {
    return at.x < 1.0 ? 0.1 : (at.x < 2.0 ? 7.1 : std::nan(""));
  };
  EXPECT_TRUE(contours_of(raster_of(cliff), 1.0, 0.05).empty());
  EXPECT_FALSE(contours_of(raster_of(cliff), 1.0, 10.0).empty()) << "the comparison sees the cliff";
}

TEST(HeightRaster, IsSmoothedButForItsSteps) {
  HeightRaster raster = raster_of(
      [](const glm::dvec2& at) { return (at.x < 1.0 ? 0.0 : 3.0) + 0.001 * std::cos(1e4 * at.x * at.y); });
  smooth_heights(2.0, 0.0275, raster);
  for (std::uint32_t column = 0; column < raster.width; ++column)
    EXPECT_NEAR(raster.at(column, 100), column < 100 ? 0.0 : 3.0, 6e-4) << column;
}

/// Ground that rises by 1 in 10 to the east, with a house of 2 x 2 m and 3 m height, on a grid of 5 cm; z up, far from the origin.
Scene ground() {
  Input input;
  std::vector<glm::dvec3>& places = input.objects.emplace_back().points.position;
  for (double x = 0.0; x < 12.0; x += 0.05)
    for (double y = 0.0; y < 8.0; y += 0.05) {
      const bool is_house = x > 5.0 && x < 7.0 && y > 3.0 && y < 5.0;
      places.emplace_back(2000.0 + x, 3000.0 + y, 400.0 + (is_house ? 4.0 : 0.1 * x));
    }
  BuildStats stats;
  Scene scene = build_scene(std::move(input), {}, 0, stats);
  scene.up = {0.0, 0.0, 1.0};
  return scene;
}

TEST(SheetContours, AreThoseOfTheGround) {
  const Sheet sheet = make_sheet(ground(), with_sheet("plan:contours=0.25,scale=100,dpi=100,unit=m"));
  double length = 0.0;
  for (const Contour& contour : sheet.contours) {
    length += length_of(contour.curve);
    for (const glm::dvec2& point : contour.curve.points)
      if (std::abs(point.y - 3004.0) > 1.3) {
        ASSERT_NEAR(point.x - 2000.0, 10.0 * (contour.height - 400.0), 0.03) << contour.height;
      }
  }
  EXPECT_NEAR(length, 4.0 * 8.0, 2.5) << "400.25 to 401, but for the house";
  const Drawing page = sheet_page(sheet, {0, 0, sheet.width, sheet.height}, {}, {});
  const auto has = [&page](const std::string& text) {
    return std::any_of(page.texts.begin(), page.texts.end(),
                       [&](const DrawnText& drawn) { return drawn.text == text; });
  };
  EXPECT_TRUE(has("400.25") && has("401.00") && has("Contours every 0.25 m"));
  const std::string dxf = sheet_dxf(sheet, {}, {});
  EXPECT_NE(dxf.find("\n8\nCONTOURS\n"), std::string::npos);
  EXPECT_NE(dxf.find("\n38\n400.5\n"), std::string::npos) << "at their height";
  EXPECT_THROW((void)make_sheet(ground(), with_sheet("plan:contours=1e-4,scale=100,dpi=100,unit=m")), Error);
  EXPECT_THROW((void)with_sheet("elevation:south,contours=1"), Error);
  EXPECT_THROW((void)with_sheet("plan:contours=0"), Error);
}

/// A room of 4 x 3 x 2.5 m with a table of 0.8 m, its floor at 100.3.
Scene room_with_table() {
  Input input;
  std::vector<glm::dvec3>& places = input.objects.emplace_back().points.position;
  const auto add = [&](double width, double depth, double height) {
    for (double x = 0.0; x < width; x += 0.04)
      for (double y = 0.0; y < depth; y += 0.04) places.emplace_back(x, y, 100.3 + height);
  };
  add(4.0, 3.0, 0.0);
  add(4.0, 3.0, 2.5);
  add(2.0, 2.0, 0.8);
  for (double along = 0.0; along < 4.0; along += 0.04)
    for (double z = 0.04; z < 2.5; z += 0.04) places.emplace_back(along, 3.0, 100.3 + z);
  BuildStats stats;
  Scene scene = build_scene(std::move(input), {}, 0, stats);
  scene.up = {0.0, 0.0, 1.0};
  return scene;
}

TEST(FloorLevels, AreFloorTableAndCeiling) {
  const std::vector<double> levels = floor_levels(room_with_table(), {}, {0.0, 0.0, 1.0}, 1.0);
  ASSERT_EQ(levels.size(), 3U);
  EXPECT_NEAR(levels[0], 100.3, 0.002);
  EXPECT_NEAR(levels[1], 101.1, 0.002);
  EXPECT_NEAR(levels[2], 102.8, 0.002);
}

TEST(FloorLevels, AreMarkedBesideSections) {
  const Sheet sheet =
      make_sheet(room_with_table(), with_sheet("section:0,1,4,1,level=100.3,scale=50,dpi=100,unit=m"));
  const Drawing page = sheet_page(sheet, {0, 0, sheet.width, sheet.height}, {}, {});
  std::map<std::string, double> marks;
  for (const DrawnText& text : page.texts)
    if (text.text.starts_with('+')) marks[text.text] = text.at.y;
  ASSERT_EQ(marks.size(), 3U);
  EXPECT_NEAR(marks.at("+0.00") - marks.at("+2.50"), 50.0, 0.2) << "2.5 m at 1 : 50";
  EXPECT_NEAR(marks.at("+0.00") - marks.at("+0.80"), 16.0, 0.2);
  EXPECT_TRUE(make_sheet(room_with_table(), with_sheet("section:0,1,4,1,scale=50,dpi=100")).levels.empty());
  EXPECT_NE(sheet_dxf(sheet, {}, {}).find("\n8\nLEVELS\n"), std::string::npos);
}

/// At 1 : 200 the table is 4 mm above the floor, at 1 : 500 1.6 mm: a page lacks no level that DXF has.
TEST(FloorLevels, AreAllMarkedWhereTheyLieCloseTogether) {
  for (const char* scale : {"scale=200,dpi=200", "scale=500,dpi=300"}) {
    const Sheet sheet =
        make_sheet(room_with_table(), with_sheet("section:0,1,4,1,level=100.3,unit=m," + std::string(scale)));
    const Drawing page = sheet_page(sheet, {0, 0, sheet.width, sheet.height}, {}, {});
    std::vector<DrawnText> marks;
    for (const DrawnText& text : page.texts)
      if (text.text.starts_with('+') && text.size_mm == LABEL_SIZE_MM) marks.push_back(text);
    ASSERT_EQ(marks.size(), 3U) << scale;
    for (std::size_t i = 0; i < marks.size(); ++i)
      for (std::size_t k = 0; k < i; ++k)
        EXPECT_FALSE(text_box(marks[i]).meets(text_box(marks[k]))) << marks[i].text << ' ' << marks[k].text;
    const double floor = marks[0].at.y + 0.4 * LABEL_SIZE_MM;
    for (const double height : {0.8, 2.5})
      EXPECT_TRUE(std::any_of(page.lines.begin(), page.lines.end(), [&](const DrawnLine& line) {
        return std::abs(floor - line.from.y - 1000.0 * height / sheet.asked.scale) < 0.2;
      })) << "the line leaves where the level is";
  }
}

TEST(SheetNotes, SayWhatMayBeAnotherSheetThanIsMeant) {
  const auto notes = [](const std::string& text) {
    return odd_sheet(make_sheet(room_with_table(), with_sheet(text + ",scale=50,dpi=50")));
  };
  EXPECT_TRUE(notes("plan:z=101,unit=m").empty());
  EXPECT_TRUE(notes("plan:unit=m").empty()) << "it is no cut";
  EXPECT_EQ(notes("plan:z=110,unit=m"),
            std::vector<std::string>{"the sheet's cut at height 110 meets no surface"});
  EXPECT_TRUE(notes("plan:z=110,unit=m,weight=0").empty()) << "nobody looked";
  EXPECT_EQ(notes("plan:z=101").size(), 1U) << "a scan in feet is not at that scale";
}

}  // namespace
}  // namespace splatray
