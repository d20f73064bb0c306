// Pictures from the GPU against pictures by brute force in float64 (reference_path.h), scene by scene. Three
// numbers each: an error of a pixel that does not count, the share of pixels that may exceed it, and a limit
// that none may exceed. Pixels whose truth turns on float32's last bits (nudge of reference_picture) are counted
// apart, as no renderer in float32 can meet it.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <iostream>
#include <numbers>

#include "app/library/image_file.h"
#include "app/library/picture/compare.h"
#include "data/shapes.h"
#include "engine/device/host/host_device.h"
#include "engine/device/vulkan/vulkan_device.h"
#include "engine/scene/splat.h"
#include "tests/all_tests.h"
#include "tests/gpu/shown_tracer.h"
#include "tests/temp_folder.h"
#include "tests/trace/reference_path.h"
#include "tests/trace/scenes.h"

namespace splatray::testing {
namespace {

constexpr std::uint64_t SPLATS = 20000;  ///< of each scene, so that brute force takes seconds

/// The two pictures of one scene, with the picture of the GPU set to the truth where there is no truth to meet.
struct Pictures {
  Image gpu;
  Image reference;
  double unsettled = 0.0;  ///< share of these pixels
};

Settings small_settings() {
  Settings settings;
  settings.samples = 4;
  settings.max_bounces = 6;
  return settings;
}

/// A picture, and what was counted.
struct Made {
  Image image;
  RenderStats stats;
};
Made made_on(const Device& device, const Scene& scene, const View& view, const Settings& settings,
             const Environment& environment) {
  ShownTracer tracer(device);
  tracer.upload(scene);
  tracer.set_environment(environment);
  Made made{tracer.render(view, settings), {}};
  made.stats = tracer.stats();
  return made;
}

Image gpu_picture(const Scene& scene, const View& view, const Environment& environment) {
  static VulkanDevice device;
  return made_on(device, scene, view, small_settings(), environment).image;
}

float most_of(const vec3& difference) { return std::max({difference.x, difference.y, difference.z}); }

/// Takes the truth for those pixels of `pictures.gpu` that are further than `error` from it and whose truth moves by more than
/// `move` (display values) in one of the `nudged` pictures.
void settle(Pictures& pictures, const std::array<Image, 2>& nudged, double error, double move) {
  const std::vector<vec3> truth = display_image(pictures.reference, 0.0).rgb;
  const std::vector<vec3> made = display_image(pictures.gpu, 0.0).rgb;
  std::vector<bool> unsettled(truth.size(), false);
  for (const Image& image : nudged) {
    const std::vector<vec3> moved = display_image(image, 0.0).rgb;
    for (std::size_t pixel = 0; pixel < truth.size(); ++pixel)
      if (most_of(glm::abs(made[pixel] - truth[pixel])) >= float(error) &&
          most_of(glm::abs(moved[pixel] - truth[pixel])) > float(move))
        unsettled[pixel] = true;
  }
  for (std::size_t pixel = 0; pixel < truth.size(); ++pixel)
    if (unsettled[pixel]) pictures.gpu.rgba[pixel] = pictures.reference.rgba[pixel];
  pictures.unsettled += double(std::count(unsettled.begin(), unsettled.end(), true)) / double(truth.size());
}

/// A few of float32's last bits: what a direction of the GPU is off by after a hit.
constexpr double NUDGE = 0x1p-21;
/// What a normal is off by where a hit's position is by two of float32's steps, a quarter of a lattice unit, on discs of some
/// 20 000 units. Asked only of pixels that are off by more than any may be.
constexpr double STEPPED = 0x1p-16;

Pictures pictures_of(Scene scene, const Tolerance& tolerance) {
  View view{default_camera(scene, 4.0 / 3.0), all_or(96U, 64U), all_or(72U, 48U)};
  if (scene.lights.empty()) scene.lights = default_lights(scene, view.camera);
  const Environment environment =
      scene.environment_path.empty() ? studio_environment() : read_environment(scene.environment_path);
  const BruteForce brute(scene);
  const auto truth = [&](const glm::dvec3& nudge) {
    return reference_picture(scene, brute, view, small_settings(), environment, nudge);
  };
  const auto nudged = [&](double by) {
    return std::array{truth(by * glm::dvec3(1.0, -1.0, 1.0)), truth(by * glm::dvec3(-1.0, 1.0, 1.0))};
  };
  Pictures pictures{gpu_picture(scene, view, environment), truth(glm::dvec3(0.0))};
  settle(pictures, nudged(NUDGE), 0.0, 0.5 * tolerance.threshold);
  if (compare(display_image(pictures.gpu, 0.0), display_image(pictures.reference, 0.0), tolerance).worst >
      tolerance.limit)
    settle(pictures, nudged(STEPPED), tolerance.limit, 0.5 * tolerance.limit);
  return pictures;
}

/// Compares; keeps the pictures of a failure beside the test program.
Comparison compare_pictures(const Image& gpu, const Image& reference, const Tolerance& tolerance,
                            const std::string& name) {
  const DisplayImage picture = display_image(gpu, 0.0);
  const DisplayImage truth = display_image(reference, 0.0);
  Comparison result = compare(picture, truth, tolerance);
  std::cout << name << ": " << describe(result, tolerance) << '\n';
  if (!result.passed) {
    write_png(picture, {}, "picture_test_" + name + ".png");
    write_png(truth, {}, "picture_test_" + name + ".reference.png");
    write_png(result.difference, {}, "picture_test_" + name + ".difference.png");
  }
  return result;
}

struct SceneCase {
  const char* name;
  bool nightly;
  bool needs_data;
  Tolerance tolerance;
  double unsettled;  ///< share of pixels that may be
  const char* why;
};

std::ostream& operator<<(std::ostream& out, const SceneCase& scene_case) { return out << scene_case.name; }

class ScenePicture : public ::testing::TestWithParam<SceneCase> {};

TEST_P(ScenePicture, MatchesBruteForce) {
  const SceneCase& scene_case = GetParam();
  if (scene_case.nightly) SPLATRAY_NIGHTLY();
  if (scene_case.needs_data && !data_folder())
    GTEST_SKIP() << "SPLATRAY_DATA_DIR is not set: " << scene_case.name << " is not compared";
  const std::string name = scene_case.name;
  const TempFolder points;
  if (!scene_case.needs_data) write_model(name, SPLATS, points.path());
  const std::filesystem::path file = std::filesystem::path(SPLATRAY_SCENES) / (name + ".gltf");
  const Pictures pictures =
      pictures_of(scene_of_file(file, SPLATS, 10, scene_case.needs_data ? *data_folder() : points.path()),
                  scene_case.tolerance);
  std::cout << name << ": " << 100.0 * pictures.unsettled << " % of pixels turn on last bits\n";
  EXPECT_LE(pictures.unsettled, scene_case.unsettled);
  EXPECT_TRUE(compare_pictures(pictures.gpu, pictures.reference, scene_case.tolerance, name).passed)
      << scene_case.why;
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, ScenePicture,
    ::testing::Values(
        SceneCase{"table1_dragon",
                  false,
                  true,
                  {0.004, 0.0005, 0.05},
                  0.001,
                  "matte: nothing but float32 shading differs"},
        SceneCase{"table1_david",
                  true,
                  true,
                  {0.004, 0.0005, 0.05},
                  0.001,
                  "matte: nothing but float32 shading differs"},
        SceneCase{"reflective_buddha",
                  true,
                  true,
                  {0.02, 0.001, 0.27},
                  0.001,
                  "texture units filter with 8-bit weights, and mirrored rays may graze past a disc"},
        SceneCase{"refractive_dragon",
                  true,
                  true,
                  {0.02, 0.004, 0.25},
                  0.01,
                  "as the Buddha; each hit in glass multiplies last bits, until a choice tips or another "
                  "place is hit (tests/hard/cross_device.md)"},
        SceneCase{
            "teapot", true, true, {0.02, 0.0005, 0.1}, 0.001, "as the dragon, in a part of the picture"},
        SceneCase{
            "room", false, false, {0.004, 0.0005, 0.05}, 0.001, "smooth mirror and glass, so few paths tip"},
        SceneCase{
            "demo", true, false, {0.004, 0.0005, 0.05}, 0.001, "smooth mirror and glass, so few paths tip"}),
    [](const auto& scene) { return std::string(scene.param.name); });

/// A ball of glass on a floor that is half a mirror.
Scene ball_on_mirror() {
  Material mirror = test_material(MATERIAL_TWO_SIDED);
  mirror.phong.mirror = 0.5F;
  return scene_of(
      {{sphere({.count = 4000}, 1.0), test_material(MATERIAL_DIELECTRIC)},
       {rectangle({.count = 4000}, {-3.0, -1.0, -3.0}, {0.0, 0.0, 6.0}, {6.0, 0.0, 0.0}), mirror}});
}

TEST(Picture, TheHostMakesThatOfTheDevice) {
  Scene scene = ball_on_mirror();
  const View view{default_camera(scene, 4.0 / 3.0), 64, 48};
  scene.lights = default_lights(scene, view.camera);
  const VulkanDevice device;
  const HostDevice host;
  for (const std::uint32_t look : {LOOK_PAPER, LOOK_LIT, LOOK_AO, LOOK_SCAN}) {
    Settings settings = small_settings();
    settings.look = look;
    settings.counters = true;
    settings.aov = true;
    const Made expected = made_on(device, scene, view, settings, studio_environment());
    const Made made = made_on(host, scene, view, settings, studio_environment());
    const Tolerance tolerance{0.004, 0.0005, 0.05};
    EXPECT_TRUE(
        compare_pictures(made.image, expected.image, tolerance, "host_" + std::to_string(look)).passed);
    for (const std::uint32_t counter : {COUNT_PRIMARY, COUNT_HITS})
      EXPECT_EQ(made.stats.counters[counter], expected.stats.counters[counter]);
    EXPECT_GT(made.stats.counters[COUNT_TESTS], made.stats.counters[COUNT_HITS]);  // by another tree
    for (std::size_t i = 0; i < made.image.aov.size(); ++i) {
      EXPECT_EQ(made.image.aov[i].splat, expected.image.aov[i].splat);
      EXPECT_EQ(made.image.aov[i].object, expected.image.aov[i].object);
    }
  }
}

/// From within a ball a panorama's depths are those of its rays with the ball, on either device.
TEST(Picture, APanoramaWithinABallHasItsDepths) {
  constexpr std::uint32_t WIDTH = 96, HEIGHT = 48;
  Material two_sided = test_material(MATERIAL_TWO_SIDED);
  const Scene scene = scene_of({{sphere({.count = 20000}, 1.0), two_sided}});
  for (const glm::dvec3 eye : {glm::dvec3(0.0), glm::dvec3(0.3, -0.5, 0.2)}) {
    Camera camera{eye, eye + glm::dvec3(0.0, 0.3, -1.0), {0.0, 1.0, 0.0}};
    camera.panorama = true;
    const View view{camera, WIDTH, HEIGHT};
    Settings settings = small_settings();
    settings.aov = true;
    const Image device = made_on(VulkanDevice(), scene, view, settings, studio_environment()).image;
    const Image host = made_on(HostDevice(), scene, view, settings, studio_environment()).image;
    EXPECT_TRUE(compare_pictures(host, device, {0.004, 0.0005, 0.05}, "panorama").passed);
    for (std::uint32_t y = 0; y < HEIGHT; ++y)
      for (std::uint32_t x = 0; x < WIDTH; ++x) {
        const double longitude = 2.0 * std::numbers::pi * ((x + 0.5) / WIDTH - 0.5);
        const double latitude = std::numbers::pi * (0.5 - (y + 0.5) / HEIGHT);
        const glm::dvec3 dir(std::cos(latitude) * std::sin(longitude), std::sin(latitude),
                             -std::cos(latitude) * std::cos(longitude));
        const double along = glm::dot(eye, dir);
        const double depth = std::sqrt(along * along + 1.0 - glm::dot(eye, eye)) - along;
        const std::size_t i = std::size_t{y} * WIDTH + x;
        ASSERT_NEAR(host.aov[i].z, depth, 0.002) << x << ", " << y;
        ASSERT_NEAR(host.aov[i].z, device.aov[i].z, 1e-5);
        ASSERT_EQ(host.aov[i].splat, device.aov[i].splat);
      }
  }
}

TEST(Picture, NoLensWithoutPerspective) {
  const Scene scene = ball_on_mirror();
  View view{default_camera(scene, 2.0), 48, 24};
  Settings sharp = small_settings(), with_lens = sharp;
  sharp.look = with_lens.look = LOOK_LIT;
  with_lens.lens_radius_world = 0.1;
  const auto picture = [&](const Settings& settings) {
    return made_on(HostDevice(), scene, view, settings, studio_environment()).image.rgba;
  };
  EXPECT_NE(picture(with_lens), picture(sharp));
  view.camera.ortho_height = 3.0;
  EXPECT_EQ(picture(with_lens), picture(sharp));
  view.camera.ortho_height = 0.0;
  view.camera.panorama = true;
  EXPECT_EQ(picture(with_lens), picture(sharp));
}

TEST(Picture, AMovedSplatIsNoticed) {
  Scene scene = scene_of({{sphere({.count = 500}, 1.0), test_material(0)}});
  const View view{default_camera(scene, 4.0 / 3.0), all_or(96U, 64U), all_or(72U, 48U)};
  scene.lights = default_lights(scene, view.camera);
  const Environment environment = studio_environment();
  const Image gpu = gpu_picture(scene, view, environment);
  BruteForce brute(scene);
  const Tolerance tolerance{0.004, 0.0005, 0.05};
  const Image same = reference_picture(scene, brute, view, small_settings(), environment);
  EXPECT_TRUE(compare_pictures(gpu, same, tolerance, "sphere").passed);

  const FrameParams frame = make_frame_params(scene, view, small_settings());
  RayQuery centre{};
  centre.origin = frame.origin_00;
  centre.dir = glm::normalize(frame.dir_00 + frame.dir_dx * 48.0F + frame.dir_dy * 36.0F);
  centre.from_object = NO_OBJECT;
  const TrueHit hit = brute.nearest(centre, small_settings());
  ASSERT_TRUE(hit.found);
  const Splat& splat = brute.splats()[hit.first];
  brute.move_splat(hit.first, std::sqrt(splat.radius_squared) * splat.normal);
  const Image moved = reference_picture(scene, brute, view, small_settings(), environment);
  EXPECT_FALSE(compare_pictures(gpu, moved, tolerance, "moved").passed);
}

/// Under light from everywhere, mirrors and glass send on all of it: every pixel is 1, but for what the
/// bounce limit cuts.
TEST(Picture, WhiteFurnaceReturnsAllEnergy) {
  Material mirror = test_material(0);
  mirror.phong.mirror = 1.0F;
  mirror.phong.tint = vec3(1.0F);
  Material glass = test_material(MATERIAL_DIELECTRIC);
  glass.phong.tint = vec3(1.0F);
  glass.phong.specular = 0.0F;
  for (const Material& material : {mirror, glass}) {
    const Scene scene = scene_of({{sphere({.count = 20000}, 1.0), material}});
    static VulkanDevice device;
    ShownTracer tracer(device);
    tracer.upload(scene);
    tracer.set_environment({0, 0, {}, glm::vec3(1.0F)});
    Settings settings;
    settings.samples = 16;
    settings.max_bounces = 32;
    settings.counters = true;
    const Image image = tracer.render({default_camera(scene, 1.0), 128, 128}, settings);
    double sum = 0.0;
    for (const vec4& pixel : image.rgba) sum += double(pixel.x + pixel.y + pixel.z) / 3.0;
    const auto& counters = tracer.stats().counters;
    const double lost = double(counters[COUNT_ENERGY_LOST]) / 1024.0 / double(counters[COUNT_PRIMARY]);
    EXPECT_NEAR(sum / double(image.rgba.size()) + lost, 1.0, 1e-4);
    EXPECT_EQ(counters[COUNT_NON_FINITE], 0U);
    EXPECT_EQ(counters[COUNT_LOST], 0U);
  }
}

}  // namespace
}  // namespace splatray::testing
