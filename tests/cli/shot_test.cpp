/// What is chosen for pictures of which nothing is said.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "app/library/request/command_line.h"
#include "app/library/request/fields.h"
#include "app/library/request/request_json.h"
#include "app/library/shot/lights.h"
#include "app/library/shot/picture_lights.h"
#include "app/library/shot/resolve.h"
#include "engine/base/error.h"
#include "engine/base/srgb.h"
#include "engine/scene/scene_splat.h"
#include "tests/gpu/small_scene.h"
#include "tests/host/scenes.h"

namespace splatray {
namespace {

/// A flat site of 50 x 50 points, on a slope along x.
Scene site() {
  OrientedPoints points;
  for (int x = 0; x < 50; ++x)
    for (int y = 0; y < 50; ++y) points.emplace_back(glm::dvec3(x, y, 0.1 * x), glm::dvec3(0.0, 0.0, 1.0));
  return scan_scene(points);
}

Scene room() { return scan_scene(box_points({4.0, 5.0, 3.0}, true)); }

Shot shot_of(const Scene& scene, const Request& request = {}) {
  return resolve(request, scene, facts_of(scene));
}

Request suited(const Scene& scene, const Request& request = {}) { return shot_of(scene, request).request; }

/// What the picture is of, and the choices.
std::string said(const Shot& shot) { return shot.of + ": " + choices_text(shot); }

/// A grey for each splat, from `dark` to `bright`.
void colour(Scene& scene, float dark, float bright) {
  scene.color_pool.edit().clear();
  for (std::size_t i = 0; i < scene.data_pool.size(); ++i) {
    const float share = static_cast<float>(i) / static_cast<float>(scene.data_pool.size());
    scene.color_pool.edit().push_back(pack_color(glm::vec3(dark + share * (bright - dark))));
  }
}

TEST(Shot, OfAModelIsAsAskedForButForNoise) {
  Scene model = site();
  model.stations.clear();
  Request asked;
  asked.output.denoise = false;
  EXPECT_EQ(suited(model, asked), asked);
  EXPECT_EQ(said(shot_of(model, asked)), ": ");
  EXPECT_EQ(said(shot_of(model)), ": --denoise");
}

TEST(Shot, NoiseIsTakenOutOfWholePicturesForLookingAt) {
  const auto denoises = [](const std::string& options) {
    return shot_of(site(), parse_command_line("splatray-render a.ply " + options)).denoises();
  };
  EXPECT_TRUE(denoises(""));
  EXPECT_TRUE(denoises("-o a.jpg --look lit --samples 256"));
  EXPECT_FALSE(denoises("--tile 1/2") || denoises("--crop 0,0,8,8"));
  EXPECT_FALSE(denoises("-o a.exr")) << "is measured";
  EXPECT_FALSE(denoises("--look paper")) << "has none";
  EXPECT_TRUE(denoises("--keep-noise --denoise")) << "the last one holds";
  EXPECT_FALSE(denoises("--denoise --keep-noise") || denoises("--keep-noise"));
  EXPECT_FALSE(denoises("--despeckle") || denoises("--reference b.png"));
  EXPECT_FALSE(denoises("--error 0.1") || denoises("--time 1")) << "is as good as it is asked to be";
  EXPECT_FALSE(denoises("--samples 64 --sample-offset 64") || denoises("--samples 1"));
}

/// The one sentence that refuses what is asked for beside a scene; empty where nothing does.
std::string sentence_against(const std::string& options) {
  try {
    static_cast<void>(parse_command_line("splatray-render a.ply " + options));
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    return error.what();
  }
  return "";
}

TEST(Consistent, WhatExcludesOrNeedsOthersIsNamed) {
  constexpr std::pair<const char*, const char*> REFUSED[] = {
      {"--tile 1/2 --crop 0,0,8,8", "found --tile and --crop, expected one of them"},
      {"--samples 256 --sample-offset 3",
       "found --sample-offset 3 with --samples 256, expected a multiple of"},
      {"--samples 64 --sample-offset 65535", "found --sample-offset 65535 with --samples 64, expected"},
      {"--sample-offset 64 --samples 64 --aov error -o a.exr",
       "found --aov error with --sample-offset, expected it for all samples of a picture"},
      {"--tile 1/9 --resolution 8x8", "found --tile of 9 parts, expected at most the picture's 8 rows"},
      {"--crop 9,0,8,8 --resolution 8x8", "found --crop beyond the picture's 8x8 pixels"},
      {"--error 0.1 --crop 0,0,8,8",
       "found --error and --crop, expected one of them, as parts of a picture have the same --samples"},
      {"--time 9 --tile 1/2", "found --time and --tile, expected one of them"},
      {"--error 0.1 --sample-offset 64", "found --error and --sample-offset, expected one of them"},
      {"--denoise --tile 1/2",
       "found --denoise and --tile, expected one of them, as parts that are joined keep their noise"},
      {"--despeckle --sample-offset 64", "found --despeckle and --sample-offset, expected one of them"},
      {"--reference a.png --crop 0,0,8,8",
       "found --crop and --reference, expected one of them, as whole pictures are compared"},
      {"--resume a.exr --error 0.1",
       "found --error and --resume, expected one of them, as that goes up to --samples"},
      {"--resume a.exr --turntable 8",
       "found --turntable and --resume, expected one of them, as these are of a single picture"},
      {"--frames 0-3", "found --frames alone, expected --turntable or --camera-path beside it"},
      {"--turntable 8 --camera-path a.json", "found --camera-path and --turntable, expected one of them"},
      {"--camera-path a.json --eye 1,2,3",
       "found --eye and --camera-path, expected one of them, as the path has its cameras"},
      {"--turntable 8 --reference a.png", "found --turntable and --reference, expected one of them"},
      {"--turntable 8 -o a.png", "expected a name with one run of #"},
      {"--target 1,2,3", "found --target alone, expected --eye beside it"},
      {"--ortho-height 2", "found --ortho-height alone, expected --eye beside it"},
      {"--camera-up 0,0,1", "found --camera-up alone, expected --eye beside it"},
      {"--ink", "found --ink alone, expected --sheet beside it"},
      {"--xray", "found --xray alone, expected --sheet beside it"},
      {"--measures a.geojson", "found --measures alone, expected --sheet beside it"},
      {"--height-raster a.tif", "found --height-raster alone, expected --sheet beside it"},
      {"--sheet plan --eye 1,2,3",
       "found --eye and --sheet, expected one of them, as a sheet has its camera"},
      {"--sheet plan --resolution 8x8",
       "found --resolution and --sheet, expected one of them, as scale= and dpi="},
      {"--sheet plan --turntable 8", "found --turntable and --sheet, expected one of them"},
      {"--sheet plan --measures a.geojson -o a.png",
       "with --measures, expected a name ending in .svg, .pdf or .dxf"},
      {"--sheet plan --height-raster a.tif -o a.dxf",
       "with --height-raster, expected a name ending in .png, .exr, .tif, .svg or .pdf"},
      {"--sheet plan --ink --xray", "found --xray and --ink, expected one of them"},
      {"--sheet plan -o a.jpg",
       "with --sheet, expected a name ending in .png, .exr, .tif, .svg, .pdf or .dxf"},
      {"--orbit 8 -o a.png", "found output 'a.png' with --orbit, expected a name ending in .html"},
      {"--orbit 8 --sheet plan", "found --orbit and --sheet, expected one of them"},
      {"--orbit 8 --lens-shift 1,0", "found --orbit and --lens-shift, expected one of them"},
      {"--aov error --samples 1 -o a.exr", "found --aov error with one sample, expected at least two"},
      {"--denoise --despeckle", "found --despeckle and --denoise, expected one of them"},
      {"--despeckle --keep-noise", "found --despeckle and --keep-noise, expected one of them"},
      {"--denoise --samples 1", "found --denoise with one sample, expected at least two"},
      {"--denoise --look paper", "found --denoise with --look paper, expected a look that has noise"},
      {"--denoise --reference a.png",
       "found --denoise and --reference, expected one of them, as pictures are compared as they were traced"},
      {"--background transparent -o a.jpg",
       "with --background transparent, expected a name ending in .png, .webp or .exr"},
      {"--resolution 20000x8 -o a.webp",
       "found a picture of 20000x8 pixels with a .webp output, expected at most 16383 a side"},
      {"-o a.bmp", "found output 'a.bmp', expected a name ending in .png, .jpg, .webp or .exr"},
      {"--aov error -o a.png", "found output 'a.png' with --aov, expected a name ending in .exr"}};
  for (const auto& [options, sentence] : REFUSED)
    EXPECT_NE(sentence_against(options).find(sentence), std::string::npos)
        << options << ": found '" << sentence_against(options) << "', expected '" << sentence << "'";
  EXPECT_EQ(sentence_against("--sheet plan --ink --measures a.geojson -o a.pdf"), "");
}

TEST(Shot, WithoutColoursShowsTheShapeInLight) {
  const Shot land = shot_of(site());
  EXPECT_EQ(said(land), "a site: --view oblique --color-by height --look lit --denoise");
  EXPECT_EQ(land.request.view.viewpoint, Viewpoint::oblique);
  EXPECT_EQ(land.request.look.attributes.color_by, "height");
  EXPECT_EQ(land.request.look.style, LOOK_LIT);
  EXPECT_FALSE(land.settings.cutaway);
  Request gold;
  gold.look.material = "gold";
  EXPECT_EQ(suited(site(), gold).look.attributes.color_by, "plain") << "no heights over what was asked for";
}

TEST(Shot, ColoursThatAreNormalsAreNotShown) {
  Scene scene = room();
  for (std::size_t i = 0; i < splat_count(scene); ++i) {
    const glm::vec3 shown = glm::vec3(0.5) + glm::vec3(0.5) * glm::vec3(splat_at(scene, i).normal());
    scene.color_pool.edit().push_back(
        pack_color({srgb_to_linear(shown.x), srgb_to_linear(shown.y), srgb_to_linear(shown.z)}));
  }
  const Shot shot = shot_of(scene);
  EXPECT_EQ(said(shot), "a room: --view dollhouse --color-by height --look lit --denoise");
  EXPECT_TRUE(std::any_of(shot.notes.begin(), shot.notes.end(), [](const std::string& note) {
    return note.find("the normals' directions") != std::string::npos;
  }));
  Request asked;
  asked.look.attributes.color_by = "rgb";
  EXPECT_EQ(suited(scene, asked).look.attributes.color_by, "rgb");
  std::vector<std::uint32_t>& colors = scene.color_pool.edit();
  std::rotate(colors.begin(), colors.begin() + 1, colors.end());
  EXPECT_EQ(suited(scene).look.attributes.color_by, "rgb") << "as bright, elsewhere";
}

TEST(Shot, RoomsLieOpenUnlessAScannerStandsInThem) {
  Scene scene = room();
  EXPECT_EQ(said(shot_of(scene)), "a room: --view dollhouse --color-by height --look lit --denoise");
  EXPECT_TRUE(shot_of(scene).settings.cutaway);
  scene.stations[0].sensor_world = glm::dvec3(0.0);
  EXPECT_EQ(shot_of(scene).request.view.viewpoint, Viewpoint::dollhouse) << "one wall would fill the picture";
  Scene hall = scan_scene(box_points({4.0, 9.0, 3.0}, true));
  hall.stations[0].sensor_world = glm::dvec3(0.0);
  const Shot inside = shot_of(hall);
  EXPECT_EQ(said(inside), "a room: --view inside --color-by height --look scan --denoise")
      << "light comes from outside, which a closed room has none of";
  EXPECT_FALSE(inside.settings.cutaway);
}

/// The studio's lamps stand where the camera of a front view has them beside it, whichever way a scanner looked.
TEST(Shot, TheStudioTurnsToWhereAScannerLooked) {
  OrientedPoints wall;
  for (int i = 0; i < 3600; ++i)
    wall.emplace_back(glm::dvec3(3.0, 0.05 * (i % 60 - 29.5), 0.05 * (i / 60 - 29.5)), glm::dvec3(-1, 0, 0));
  Scene scene = scan_scene(wall);
  scene.stations[0].sensor_world = glm::dvec3(0.0);
  EXPECT_EQ(
      said(shot_of(scene)),
      "what one sensor saw: --view sensor --color-by plain --look lit --environment-turn 0.75 --denoise");
  EXPECT_EQ(shot_of(scene).settings.environment_turn, 0.75F);
  Request asked;
  asked.settings.environment_turn = 0.5F;
  EXPECT_EQ(shot_of(scene, asked).settings.environment_turn, 0.5F);
  asked = {};
  asked.look.environment = "sky:30,120";
  EXPECT_EQ(shot_of(scene, asked).settings.environment_turn, 0.0F) << "the sun stands where it was asked for";
}

/// Gaps between the rings of a street that was seen by one scanner are dark.
TEST(Shot, LandAroundAScannerLiesInTheDark) {
  OrientedPoints street;
  for (int i = 0; i < 9000; ++i) {
    const double along = 5.0 + 0.005 * i, across = std::fmod(i * std::numbers::phi, 1.0) - 0.5;
    street.emplace_back(glm::dvec3(along, along * across, -1.7), glm::dvec3(0, 0, 1));
  }
  Scene scene = scan_scene(street);
  scene.stations[0].sensor_world = glm::dvec3(0.0);
  EXPECT_EQ(said(shot_of(scene)),
            "what one sensor saw: --view sensor --color-by height --look lit --environment-turn 0.75 "
            "--background 0.004,0.004,0.005 --denoise");
  EXPECT_TRUE(shot_of(scene).settings.background.has_value());
  Request asked;
  asked.look.environment = "sky:30,120";
  EXPECT_FALSE(shot_of(scene, asked).settings.background.has_value()) << "the sky is seen";
  asked = {};
  asked.settings.background = glm::vec3(0.5F);
  EXPECT_EQ(shot_of(scene, asked).settings.background, glm::vec3(0.5F));
  asked = {};
  asked.view.viewpoint = Viewpoint::top;
  EXPECT_FALSE(shot_of(scene, asked).settings.background.has_value()) << "not from its scanner's place";
  asked = {};
  asked.look.style = LOOK_PAPER;
  EXPECT_FALSE(shot_of(scene, asked).settings.background.has_value());
  Scene table = scene;
  table.stations[0].sensor_world = glm::dvec3(27.5, 0.0, 60.0);
  EXPECT_FALSE(facts_of(table).sees_land) << "it lies below the camera";
  for (const char* text : {"transparent", "environment"}) {
    asked = read_request_text(std::string("{\"background\": \"") + text + "\"}", "the test");
    EXPECT_FALSE(shot_of(scene, asked).settings.background.has_value()) << text;
  }
}

TEST(Shot, DrawingsWithoutColoursAreOnWhitePaper) {
  const auto drawn = [](Scene scene, Request asked = {}) {
    asked.view.sheet = SheetRequest{};
    asked.view.sheet->dpi = 30.0;
    return shot_of(scene, asked);
  };
  EXPECT_EQ(said(drawn(room())),
            "a room: --color-by orientation --look scan --lights none --ink --tone none --exposure 0.331 "
            "--denoise");
  EXPECT_FALSE(drawn(room()).exposes);
  EXPECT_EQ(drawn(site()).request.look.attributes.color_by, "height") << "which a map is of";
  Scene coloured = room();
  colour(coloured, 0.1F, 0.8F);
  EXPECT_EQ(drawn(coloured).request.look.attributes.color_by, "rgb");
  Request asked;
  asked.look.attributes.color_by = "height";
  EXPECT_FALSE(drawn(room(), asked).request.look.lights);
  asked.look.attributes.color_by.clear();
  asked.look.exposure_ev = 1.5;
  asked.look.lights.emplace(1);
  const Shot lit = drawn(room(), asked);
  EXPECT_EQ(lit.request.look.lights->size(), 1U);
  EXPECT_EQ(lit.request.look.exposure_ev, 1.5);
}

TEST(Shot, ColoursThatSaySomethingComeFirst) {
  Scene scene = site();
  std::vector<float> intensity(scene.data_pool.size());
  for (std::size_t i = 0; i < intensity.size(); ++i) intensity[i] = static_cast<float>(i % 200);
  scene.columns = {{std::string(COLUMN_INTENSITY), intensity}};
  EXPECT_EQ(suited(scene).look.attributes.color_by, "height+intensity");
  EXPECT_EQ(suited(scene).look.style, LOOK_LIT);
  colour(scene, 0.5F, 0.5F);
  EXPECT_EQ(suited(scene).look.attributes.color_by, "height+intensity") << "all colours are one";
  colour(scene, 0.1F, 0.8F);
  EXPECT_EQ(suited(scene).look.attributes.color_by, "rgb");
  EXPECT_EQ(suited(scene).look.style, LOOK_SCAN);
  colour(scene, 0.0F, 0.0F);
  intensity.assign(intensity.size(), 7.0F);
  intensity.back() = 9.0F;
  scene.columns = {{std::string(COLUMN_INTENSITY), intensity}};
  EXPECT_EQ(suited(scene).look.attributes.color_by, "height") << "nor does one value say anything";
}

TEST(Shot, WhatIsAskedForStays) {
  Request asked;
  asked.view.viewpoint = Viewpoint::top;
  asked.look.attributes.color_by = "normal";
  asked.look.style = LOOK_CLAY;
  asked.output.despeckle = true;
  const Shot picture = shot_of(room(), asked);
  EXPECT_EQ(picture.request, asked);
  EXPECT_EQ(picture.choices, std::vector<FieldText>{});
  asked.look.style.reset();
  asked.look.environment = "white";
  EXPECT_FALSE(suited(room(), asked).look.style) << "an environment asks for its light";
}

TEST(Shot, ADollhouseMayBeSeenFromAnEyeOfOnesOwn) {
  Request asked;
  asked.view.viewpoint = Viewpoint::dollhouse;
  asked.view.eye = glm::dvec3(0.0, 0.0, 9.0);
  EXPECT_TRUE(shot_of(room(), asked).settings.cutaway);
  EXPECT_EQ(shot_of(room(), asked).view.camera.eye, *asked.view.eye);
  asked.view.viewpoint = Viewpoint::automatic;
  EXPECT_FALSE(shot_of(room(), asked).settings.cutaway);
}

TEST(Shot, ChoosingTwiceChangesNothing) {
  for (const Scene& scene : {site(), room()}) EXPECT_EQ(suited(scene, suited(scene)), suited(scene));
}

TEST(Lights, RectanglesArePointsInThePapersLookAlone) {
  Scene scene;
  scene.bounds_min_world = glm::dvec3(-1.0);
  scene.bounds_max_world = glm::dvec3(1.0);
  SceneLight lamp{LIGHT_RECTANGLE, {0.0, 5.0, 0.0}, glm::vec3(3.0F)};
  lamp.edge_u = {0.5, 0.0, 0.0};
  lamp.edge_v = {0.0, 0.0, 1.0};  // it shines down
  scene.lights = {lamp};
  const std::vector<SceneLight> lit = resolve_lights(scene, {}, {});
  EXPECT_EQ(lit, scene.lights) << "their power is the file's";
  EXPECT_EQ(lights_of_look(LOOK_LIT, lit), lit);
  const std::vector<SceneLight> paper = lights_of_look(LOOK_PAPER, lit);
  ASSERT_EQ(paper.size(), 1U);
  EXPECT_EQ(paper[0].kind, LIGHT_POINT);
  EXPECT_GT(summed_irradiance(scene, lit), 0.0);
  EXPECT_NEAR(summed_irradiance(scene, paper) / summed_irradiance(scene, lit), 1.0, 1e-6);
}

using PreviewTest = DeviceTest;

/// Building one takes longer than tracing most pictures.
TEST_F(PreviewTest, IsTracedByThePicturesOwnProgram) {
  const Scene scene = disc_scene();
  SceneOnDevice shown(device);
  shown.open(scene);
  shown.show_environment("white");
  Shot shot;
  shot.view = disc_view(16, 12);
  shot.settings = plain_settings();
  shot.settings.look = LOOK_LIT;
  shot.request.look.lights.emplace();
  shot.request.output.denoise = true;
  EXPECT_NE(preview_exposure_ev(shot, shown, shot.view.camera), 0.0);
  const std::uint32_t built = shown.tracer().pipelines_built();
  EXPECT_EQ(built, 1U);
  Settings traced = shot.traced_settings();
  ASSERT_TRUE(traced.albedo);
  traced.aov = false;
  (void)shown.tracer().render(lit_look(shot, shown, shot.view.camera).look, shot.view, traced);
  EXPECT_EQ(shown.tracer().pipelines_built(), built);
}

}  // namespace
}  // namespace splatray
