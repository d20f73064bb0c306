// Sheets: their size and place, what is cut, what is drawn on them.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <set>
#include <string>

#include "app/library/picture/picture_file.h"
#include "app/library/picture/xray.h"
#include "app/library/request/fields.h"
#include "app/library/sheet/draw_cut.h"
#include "app/library/sheet/geotiff.h"
#include "app/library/sheet/ink.h"
#include "app/library/sheet/sheet_files.h"
#include "app/library/shot/sheet_placement.h"
#include "engine/base/error.h"
#include "engine/scene/splat.h"
#include "preprocess/build.h"
#include "tests/sheet/sheet_of_ball.h"
#include "tests/trace/scenes.h"

namespace splatray {
namespace {

using testing::ball, testing::FAR_AWAY, testing::with_sheet;

TEST(SheetText, IsReadAndWrittenAlike) {
  for (const char* text :
       {"plan", "plan:z=1.2,depth=1.4,scale=20,dpi=150", "section:0,1,2.5,1,depth=3",
        "elevation:180,weight=0", "ortho:1,1,-1,unit=0.3048", "plan:paper=A3",
        "section:0,1,2.5,1,paper=A0,landscape", "plan:portrait", "plan:z=1,hatch=0", "plan:z=1,hatch=3",
        "atlas", "atlas:above=1,depth=2,scale=100,paper=A3",
        "plan:z=1,scale=20,dpi=100,paper=A2,landscape;section:0,1,2.5,1,depth=3;plan;elevation:90"}) {
    EXPECT_EQ(sheet_text(read_sheet(text)), text);
  }
  EXPECT_EQ(sheet_text(read_sheet("elevation:south,unit=ft")), "elevation:180,unit=0.3048");
}

TEST(SheetText, OfAnythingElseIsRefused) {
  for (const char* text : {"",
                           "plane",
                           "plan:scale=0",
                           "plan:scale=-5",
                           "plan:scale=nan",
                           "plan:1",
                           "plan:dpi=0",
                           "plan:dpi=1e9",
                           "plan:depth=0",
                           "plan:colour=1",
                           "section:0,0,1",
                           "section:1,1,1,1",
                           "section:0,0,1,1,z=2",
                           "elevation",
                           "elevation:up",
                           "ortho:0,0,0",
                           "plan:unit=yard",
                           "plan:weight=-1",
                           "plan:hatch=-1",
                           "plan:paper=A5",
                           "plan:paper=",
                           "plan:sideways",
                           "atlas:z=1",
                           "plan:above=1",
                           "atlas;plan",
                           "plan;atlas",
                           "plan;",
                           "plan;section",
                           "plan;elevation:south,scale=20",
                           "plan;elevation:south,portrait",
                           "plan:"})
    EXPECT_THROW((void)with_sheet(text), Error) << text;
}

TEST(Sheet, PixelsAreExactAndWholeInTheFilesCoordinates) {
  const Scene scene = ball();
  for (const char* text :
       {"plan:scale=50,dpi=300", "elevation:south,scale=20,dpi=254", "plan:z=100.3,scale=33,dpi=97"}) {
    const Sheet sheet = make_sheet(scene, with_sheet(text));
    EXPECT_DOUBLE_EQ(sheet.pixel_world, 0.0254 / sheet.asked.dpi * sheet.asked.scale);
    EXPECT_DOUBLE_EQ(sheet.camera().ortho_height, sheet.height * sheet.pixel_world);
    for (const double place : {sheet.corner.x, sheet.corner.y})
      EXPECT_NEAR(place / sheet.pixel_world, std::round(place / sheet.pixel_world), 1e-4) << text;
    EXPECT_LT(glm::length(glm::cross(sheet.right, sheet.top) - sheet.toward), 1e-12);
    // All of it, and some millimetres of paper around.
    const glm::dvec2 middle(glm::dot(glm::dvec3(FAR_AWAY, 10.0 * FAR_AWAY, 100.0), sheet.right),
                            glm::dot(glm::dvec3(FAR_AWAY, 10.0 * FAR_AWAY, 100.0), sheet.top));
    const glm::dvec2 pixel = (middle - sheet.corner) / sheet.pixel_world;
    const double radius = 1.0 / sheet.pixel_world, margin = 3.0 / sheet.pixel_mm();
    EXPECT_GT(pixel.x, radius + margin - 3.0) << text;
    EXPECT_LT(pixel.x + radius + margin - 3.0, sheet.width) << text;
    EXPECT_GT(-pixel.y, radius + margin - 3.0) << text;
    EXPECT_LT(-pixel.y + radius + margin - 3.0, sheet.height) << text;
  }
}

TEST(Sheet, UnitsAreThoseOfTheFileOrTheRequest) {
  Scene scene = ball();
  EXPECT_FALSE(make_sheet(scene, with_sheet("plan")).unit_known);
  const double metres = make_sheet(scene, with_sheet("plan:unit=m")).pixel_world;
  EXPECT_DOUBLE_EQ(make_sheet(scene, with_sheet("plan:unit=ft")).pixel_world, metres / 0.3048);
  scene.crs =
      "PROJCS[\"x\",GEOGCS[\"g\",UNIT[\"degree\",0.0174]],UNIT[\"US survey foot\",0.3048006096012192]]";
  EXPECT_DOUBLE_EQ(make_sheet(scene, with_sheet("plan")).pixel_world, metres / 0.3048006096012192);
  scene.crs = "GEOGCS[\"WGS 84\",DATUM[\"d\"],UNIT[\"degree\",0.0174532925199433]]";
  EXPECT_THROW((void)make_sheet(scene, with_sheet("plan")), Error);
}

TEST(Sheet, SidesAreWhereASurveyorExpectsThem) {
  const Scene scene = ball();
  const auto axes = [&](const char* text) {
    const Sheet sheet = make_sheet(scene, with_sheet(text));
    return std::array{sheet.right, sheet.top, sheet.toward};
  };
  const auto expect = [](const std::array<glm::dvec3, 3>& found, glm::dvec3 right, glm::dvec3 top,
                         glm::dvec3 toward) {
    EXPECT_LT(glm::distance(found[0], right) + glm::distance(found[1], top) + glm::distance(found[2], toward),
              1e-9);
  };
  const glm::dvec3 x(1.0, 0.0, 0.0), y(0.0, 1.0, 0.0), z(0.0, 0.0, 1.0);
  expect(axes("plan"), x, y, z);
  expect(axes("elevation:south"), x, z, -y);
  expect(axes("elevation:north"), -x, z, y);
  expect(axes("elevation:east"), y, z, x);
  expect(axes("ortho:0,0,-1"), x, y, z);
  expect(axes("section:499990,5000000,500010,5000000"), x, z, -y);
  expect(axes("section:500010,5000000,499990,5000000"), -x, z, y);
}

TEST(Sheet, OfNothingOrTooManyPixelsIsRefused) {
  const Scene scene = ball();
  for (const char* text : {"plan:z=50", "section:0,0,1,0,depth=1", "plan:scale=1e-4,dpi=2400"})
    EXPECT_THROW((void)make_sheet(scene, with_sheet(text)), Error) << text;
}

/// Points at the corners of a square of this width and in it, so many a side.
Scene square(double width, int side) {
  testing::TestObject object{OrientedPoints{}, testing::test_material(MATERIAL_TWO_SIDED)};
  for (int i = 0; i < side * side; ++i) {
    object.points.position.emplace_back(width * (i % side) / (side - 1), width * (i / side) / (side - 1),
                                        0.0);
    object.points.normal.emplace_back(0.0F, 0.0F, 1.0F);
  }
  Scene scene = testing::scene_of({object});
  scene.up = {0.0, 0.0, 1.0};
  return scene;
}

TEST(Sheet, MayHaveManyPixelsWhereThereAreManyPoints) {
  const Request request = with_sheet("plan:scale=1000,dpi=20");
  EXPECT_LT(make_sheet(square(7000.0, 15), request).width, 6000U) << "less than A2 at 300 dpi";
  try {
    (void)make_sheet(square(10000.0, 15), request);
    FAIL() << "62 million pixels for 225 splats";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    EXPECT_NE(std::string(error.what()).find("for a scene of 225 splats, expected at most 35 million pixels"),
              std::string::npos)
        << error.what();
  }
  EXPECT_GT(make_sheet(square(10000.0, 170), request).width, 7800U)
      << "28900 splats, which are 46 pixels apart";
}

TEST(Sheet, APlanShowsARoofThatHangsOverTheGround) {
  testing::TestObject object{OrientedPoints{}, testing::test_material(MATERIAL_TWO_SIDED)};
  const auto add = [&](double x, double y, double z) {
    object.points.position.emplace_back(x, y, z);
    object.points.normal.emplace_back(0.0F, 0.0F, 1.0F);
  };
  for (int i = 0; i < 100 * 100; ++i) add(i % 100, i / 100, 0.0);
  for (int i = 0; i < 10 * 10; ++i) add(40 + i % 10, 40 + i / 10, 12.0);
  Scene scene = testing::scene_of({object});
  scene.up = {0.0, 0.0, 1.0};
  EXPECT_GT(make_sheet(scene, with_sheet("plan:scale=500")).near, 12.0);
  EXPECT_LT(make_sheet(scene, with_sheet("elevation:south,scale=500")).near, 2.0) << "from a side, as before";
}

TEST(Sheet, OfCoordinatesThatHaveNoPixelsIsRefused) {
  Scene scene = ball();
  scene.root.origin_world.x = scene.bounds_max_world.x = 1e17;
  try {
    (void)make_sheet(scene, with_sheet("plan"));
    FAIL() << "the grid's lines would have no end";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    EXPECT_NE(std::string(error.what()).find("coordinates of 1e+17, which are too large"), std::string::npos)
        << error.what();
  }
}

TEST(CutLines, AreOfSheetsThatCut) {
  const Scene scene = ball();
  const double radius = std::sqrt(1.0 - 0.3 * 0.3);
  const Sheet sheet = make_sheet(scene, with_sheet("plan:z=100.3"));
  ASSERT_EQ(sheet.cut_curves.size(), 1U);
  EXPECT_TRUE(sheet.cut_curves[0].closed);
  for (const glm::dvec2& point : sheet.cut_curves[0].points)
    ASSERT_NEAR(glm::distance(point, glm::dvec2(FAR_AWAY, 10.0 * FAR_AWAY)), radius, 5e-4);
  EXPECT_TRUE(make_sheet(scene, with_sheet("plan:z=100.3,weight=0")).cut_curves.empty());
  EXPECT_TRUE(make_sheet(scene, with_sheet("plan")).cut_curves.empty()) << "nothing is cut";
}

TEST(CutLines, AreAsWideOnPaperAsAskedFor) {
  Sheet sheet;
  sheet.asked.dpi = 254.0;  // ten pixels a millimetre
  sheet.asked.weight_mm = 0.8;
  sheet.corner = {0.0, 20.0};
  sheet.cut_curves = {{{glm::dvec2(-50.0, 10.0), glm::dvec2(50.0, 10.0)}, false}};
  Image image{20, 20, std::vector<vec4>(400, vec4(1.0F)), {}};
  draw_cut(sheet, {0, 0, 20, 20}, image);
  double black = 0.0;
  for (std::size_t row = 0; row < 20; ++row) black += 1.0 - static_cast<double>(image.rgba[row * 20 + 10].x);
  EXPECT_NEAR(black, 8.0, 1e-3);
  EXPECT_EQ(image.rgba[10 * 20 + 10], vec4(0.0F, 0.0F, 0.0F, 1.0F));
}

/// A slope of `rise` a pixel, and a step of `step` in its middle.
Image slope(float rise, float step) {
  Image image{16, 8, std::vector<vec4>(128, vec4(1.0F)), std::vector<AovPixel>(128)};
  for (std::size_t i = 0; i < 128; ++i) {
    const auto x = static_cast<float>(i % 16);
    image.aov[i].normal = glm::normalize(vec3(rise, 0.0F, 1.0F));
    image.aov[i].z = 10.0F + rise * x + (i % 16 >= 8 ? step : 0.0F);
  }
  return image;
}

TEST(Ink, IsWhereDepthStepsAndNotOnSlopes) {
  Sheet sheet;
  sheet.asked.dpi = 100.0;
  Image flat = slope(3.0F, 0.0F), stepped = slope(3.0F, 20.0F), lower = slope(3.0F, 2.0F);
  const PixelWindow all{0, 0, 16, 8};
  for (Image* image : {&flat, &stepped, &lower}) draw_ink(sheet, {all, image->aov}, all, *image);
  for (std::size_t i = 0; i < 128; ++i) {
    EXPECT_EQ(flat.rgba[i].x, 1.0F) << i;
    EXPECT_EQ(lower.rgba[i].x, 1.0F) << i;
    EXPECT_EQ(stepped.rgba[i].x, i % 16 == 7 ? 0.0F : 1.0F) << i;
  }
}

TEST(Ink, IsNotBesideWhatIsCut) {
  Sheet sheet;
  sheet.asked.dpi = 100.0;
  sheet.corner = {0.0, 8.0};
  sheet.cut_curves = {{{glm::dvec2(7.5, 0.0), glm::dvec2(7.5, 4.0)}, false, 1.5}};
  Image image = slope(3.0F, 20.0F);
  const PixelWindow all{0, 0, 16, 8};
  draw_ink(sheet, {all, image.aov}, all, image);
  EXPECT_EQ(image.rgba[7].x, 0.0F) << "far from the cut";
  EXPECT_EQ(image.rgba[7 * 16 + 7].x, 1.0F) << "beside it";
}

TEST(CutLines, ClearWhatIsSolid) {
  Sheet sheet;
  sheet.corner = {0.0, 10.0};
  sheet.width = sheet.height = 10;
  sheet.thickest_world = 6.0;
  // A pillar, its front outside.
  sheet.cut_curves = {{{{2.0, 2.0}, {2.0, 7.0}, {6.0, 7.0}, {6.0, 2.0}}, true}};
  const auto cleared = [&] {
    Image image{10, 10, std::vector<vec4>(100, vec4(1.0F)), {}};
    clear_solids(sheet, {0, 0, 10, 10}, image);
    return std::count(image.rgba.begin(), image.rgba.end(), vec4(0.0F));
  };
  EXPECT_EQ(cleared(), 20);
  std::reverse(sheet.cut_curves[0].points.begin(), sheet.cut_curves[0].points.end());
  EXPECT_EQ(cleared(), 0) << "a room";
}

TEST(Ink, OfAPartIsThatOfTheWhole) {
  Sheet sheet;
  sheet.asked.dpi = 600.0;  // lines of several pixels
  sheet.width = 16;
  sheet.height = 8;
  const PixelWindow all{0, 0, 16, 8};
  Image whole = slope(3.0F, 20.0F);
  const std::vector<AovPixel> aov = whole.aov;
  draw_ink(sheet, {all, aov}, all, whole);
  for (const PixelWindow part :
       {PixelWindow{8, 0, 8, 8}, PixelWindow{0, 3, 16, 2}, PixelWindow{9, 2, 5, 6}}) {
    const PixelWindow seen = ink_window(sheet, part);
    std::vector<AovPixel> cropped;
    for (std::uint32_t y = seen.y; y < seen.y + seen.height; ++y)
      for (std::uint32_t x = seen.x; x < seen.x + seen.width; ++x) cropped.push_back(aov[y * 16 + x]);
    Image image{part.width, part.height, std::vector<vec4>(part.width * part.height, vec4(1.0F)), {}};
    draw_ink(sheet, {seen, cropped}, part, image);
    bool any = false;
    for (std::uint32_t i = 0; i < image.rgba.size(); ++i) {
      const std::uint32_t x = part.x + i % part.width, y = part.y + i / part.width;
      EXPECT_EQ(image.rgba[i], whole.rgba[y * 16 + x]) << x << ", " << y;
      any |= image.rgba[i].x < 1.0F;
    }
    EXPECT_TRUE(any) << "no line to compare";
  }
}

/// A room of 2 x 1.5 x 1 m whose points lie in squares of 2 cm, z up.
Scene square_room() {
  constexpr double STEP = 0.02, LOW = 1e-3;
  Input input;
  std::vector<glm::dvec3>& places = input.objects.emplace_back().points.position;
  const glm::dvec3 size(2.0, 1.5, 1.0);
  for (int axis = 0; axis < 3; ++axis) {
    const int a = (axis + 1) % 3, b = (axis + 2) % 3;
    for (const double side : {0.0, size[axis]})
      for (double i = LOW; i < size[a]; i += STEP)
        for (double j = LOW; j < size[b]; j += STEP) {
          glm::dvec3 place(0.0);
          place[axis] = side;
          place[a] = i;
          place[b] = j;
          places.push_back(place);
        }
  }
  BuildStats stats;
  Scene scene = build_scene(std::move(input), {}, 0, stats);
  scene.up = {0.0, 0.0, 1.0};
  return scene;
}

TEST(Xray, ShowsWallsDarkOnEvenGroundWithoutAPattern) {
  const Scene scene = square_room();
  const Sheet sheet = make_sheet(scene, with_sheet("plan:scale=20,dpi=200"));
  const PixelWindow all{0, 0, sheet.width, sheet.height};
  const Image image = xray_image(scene, scene.materials, sheet, all, {}, {});
  const auto shade_at = [&](double x, double y) {
    const glm::dvec2 at = sheet.pixel_of({x, y});
    return image.rgba[static_cast<std::size_t>(at.y) * image.width + static_cast<std::size_t>(at.x)];
  };
  EXPECT_EQ(shade_at(-0.05, 0.7).w, 0.0F) << "beside the room";
  float darkest_wall = 1.0F, lightest_wall = 0.0F, darkest_floor = 1.0F, lightest_floor = 0.0F;
  for (double along = 0.1; along < 1.4; along += 0.0031) {
    const float wall = std::min(shade_at(0.0, along).x, shade_at(0.002, along).x);
    darkest_wall = std::min(darkest_wall, wall);
    lightest_wall = std::max(lightest_wall, wall);
    for (double across = 0.1; across < 1.9; across += 0.0037) {
      const vec4 floor = shade_at(across, along);
      EXPECT_EQ(floor.w, 1.0F);
      darkest_floor = std::min(darkest_floor, floor.x);
      lightest_floor = std::max(lightest_floor, floor.x);
    }
  }
  std::printf("walls %.3f to %.3f, floor %.3f to %.3f\n", double(darkest_wall), double(lightest_wall),
              double(darkest_floor), double(lightest_floor));
  EXPECT_LT(lightest_wall, 0.1F);
  EXPECT_GT(darkest_floor, 0.6F);
  EXPECT_LT(lightest_floor - darkest_floor, 0.12F) << "discs are seen";
  Scene hidden = scene;
  hidden.materials[0].flags |= MATERIAL_HIDDEN;
  for (const vec4& pixel : xray_image(hidden, hidden.materials, sheet, all, {}, {}).rgba)
    ASSERT_EQ(pixel.w, 0.0F);
}

TEST(Xray, OfAPartIsThatOfTheWhole) {
  const Scene scene = square_room();
  const Sheet sheet = make_sheet(scene, with_sheet("elevation:south,scale=20,dpi=100"));
  const Image whole = xray_image(scene, scene.materials, sheet, {0, 0, sheet.width, sheet.height}, {}, {});
  const PixelWindow part{7, 11, sheet.width - 20, sheet.height - 15};
  const Image image = xray_image(scene, scene.materials, sheet, part, {}, {});
  for (std::uint32_t i = 0; i < image.rgba.size(); ++i) {
    const vec4 wanted = whole.rgba[(part.y + i / part.width) * whole.width + part.x + i % part.width];
    for (int channel = 0; channel < 4; ++channel)
      ASSERT_NEAR(image.rgba[i][channel], wanted[channel], 1e-3F) << i;
  }
}

TEST(GeoTags, SayWhereARasterLies) {
  const GeoTags local = geo_tags({{5.0, 9.0}, 0.25, ""});
  EXPECT_EQ(local.tiepoint, (std::vector<double>{0.0, 0.0, 0.0, 5.0, 9.0, 0.0}));
  EXPECT_EQ(local.pixel_scale, (std::vector<double>{0.25, 0.25, 0.0}));
  EXPECT_EQ(local.keys, (std::vector<std::uint16_t>{1, 1, 1, 2, 1024, 0, 1, 32767, 1025, 0, 1, 1}));
  const GeoTags utm = geo_tags({{5.0, 9.0}, 0.25, "EPSG:25832"});
  const std::vector<std::uint16_t> projected{3072, 0, 1, 25832};
  EXPECT_NE(std::search(utm.keys.begin(), utm.keys.end(), projected.begin(), projected.end()),
            utm.keys.end());
}

TEST(SheetFiles, EachOfOneStemHasADescriptionOfItsOwn) {
  std::set<std::filesystem::path> names;
  for (const char* name : {"f/a.png", "f/a.exr", "f/a.pdf", "f/a.svg", "f/a.tif"}) {
    const SheetPlaces places = sheet_places(name);
    EXPECT_EQ(places.description, std::string(name) + ".sheet.json");
    for (const auto& file : {places.description, places.world_file, places.crs, places.crs_of_gdal})
      EXPECT_TRUE(file.empty() || names.insert(file).second) << file;
  }
  EXPECT_TRUE(names.contains("f/a.pgw") && names.contains("f/a.tfw") && names.contains("f/a.png.aux.xml"));
}

TEST(SheetFiles, APngSaysHowLargeItsPixelsAre) {
  const Image image{2, 1, std::vector<vec4>(2, vec4(1.0F)), {}};
  const std::string physical("\0\0\0\x09pHYs\0\0\x27\x10\0\0\x27\x10\x01", 17);  // 10000 a metre
  const auto bytes_of = [&](const Shot& shot) {
    const std::vector<unsigned char> bytes = encode_png(shown_image(shot, image), {});
    return std::string(bytes.begin(), bytes.end());
  };
  Shot shot;
  Sheet asked;
  asked.asked = read_sheet("plan:dpi=254");
  shot.output = asked;
  const std::string sheet = bytes_of(shot);
  EXPECT_NE(sheet.find(physical), std::string::npos);
  EXPECT_LT(sheet.find(physical), sheet.find("IDAT"));
  EXPECT_EQ(bytes_of({}).find("pHYs"), std::string::npos);
}

std::size_t count(const std::string& text, const std::string& word) {
  std::size_t found = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++found;
  return found;
}

TEST(SheetFiles, DrawingsTakeMorePixelsThanCairosImages) {
  constexpr std::uint32_t WIDTH = 40000, HEIGHT = 3;
  Sheet sheet;
  sheet.width = WIDTH;
  sheet.height = HEIGHT;
  Shot shot;
  shot.view.width = WIDTH;
  shot.view.height = HEIGHT;
  shot.output = sheet;
  const DisplayImage picture{WIDTH, HEIGHT, std::vector<vec3>(std::size_t{WIDTH} * HEIGHT, vec3(0.5F)), {}};
  const auto page = [&](const char* name) {
    const auto bytes = encode_sheet(shot, picture, {}, name);
    return std::string(bytes.begin(), bytes.end());
  };
  EXPECT_EQ(count(page("a.svg"), "<image"), 3U);
  const std::string pdf = page("a.pdf");
  EXPECT_EQ(count(pdf, "/Width 16385"), 2U);
  EXPECT_EQ(count(pdf, "/Width " + std::to_string(WIDTH - 2 * 16384)), 1U);
}

}  // namespace
}  // namespace splatray
