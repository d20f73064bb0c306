// Energy, bounce limits, and lights where shading is hard.
#include <gtest/gtest.h>

#include <cmath>

#include "data/shapes.h"
#include "engine/scene/splat.h"
#include "tests/all_tests.h"
#include "tests/hard/support/clouds.h"
#include "tests/hard/support/device_scene.h"

namespace splatray::testing {
namespace {

using glm::dvec3;

const Environment WHITE{0, 0, {}, vec3(1.0F)};
const Environment BLACK{0, 0, {}, vec3(0.0F)};

/// Pixels of a white furnace that are not 1 within 1e-4, unless paths were cut; and the energy balance.
CaseRow furnace(const Material& material, std::uint32_t max_bounces, const std::string& compared) {
  const Scene scene = scene_of({{sphere({.count = 20000}, 1.0), material}});
  DeviceScene device(scene);
  Settings settings;
  settings.max_bounces = max_bounces;
  const Image image =
      device.render({default_camera(scene, 1.0), hard_width(128), hard_width(128)}, settings, WHITE);
  const double lost =
      double(device.counter(COUNT_ENERGY_LOST)) / 1024.0 / double(device.counter(COUNT_PRIMARY));
  const std::uint64_t cut = device.counter(COUNT_BOUNCE_LIMIT);
  CaseRow row = device.row(compared);
  double sum = 0.0;
  for (const vec4& pixel : image.rgba) {
    sum += double(pixel.x + pixel.y + pixel.z) / 3.0;
    row.exceptions += cut == 0 && std::abs(pixel.x - 1.0F) > 1e-4F ? 1 : 0;
  }
  const double balance = sum / double(image.rgba.size()) + lost;
  EXPECT_NEAR(balance, 1.0, 1e-4) << compared;
  row.count = image.rgba.size();
  row.unit = "pixels";
  row.exceptions += std::abs(balance - 1.0) > 1e-4 ? 1 : 0;
  row.remark = "returned + lost = 1 " + std::string(balance < 1.0 ? "- " : "+ ") +
               short_number(std::abs(balance - 1.0)) + ", " + std::to_string(cut) + " paths cut";
  return row;
}

TEST(Energy, WhiteFurnace) {
  conclude(furnace(mirror_material(), 32, "white furnace, mirror sphere: every pixel 1"));
  conclude(
      furnace(glass_material(1.5F), 64, "white furnace, glass sphere: every pixel 1, or energy accounted"));
}

TEST(Energy, BounceLimits) {
  SPLATRAY_NIGHTLY();
  for (const std::uint32_t limit : {0U, 1U, 2U, 5U, 64U})
    conclude(furnace(
        glass_material(1.5F), limit,
        "glass sphere, at most " + std::to_string(limit) + " bounces: returned and lost energy are 1"));
}

/// In a closed mirror room no path ends: all energy is lost at the limit.
TEST(Energy, MirrorRoomNeverEnds) {
  OrientedPoints points;
  for (const SurfacePatch& face : box("room", dvec3(2.0), true)) append(points, face.make({.count = 3000}));
  DeviceScene device(scene_of({{points, mirror_material()}}));
  Settings settings;
  settings.max_bounces = 64;
  settings.samples = 1;
  const View view{{.eye = {0.1, 0.2, 0.3}, .target = {0.7, 0.5, -0.9}, .fov_y_deg = 90.0},
                  hard_width(128),
                  hard_width(128)};
  const Image image = device.render(view, settings, WHITE);
  CaseRow row = device.row("paths that get out of a closed mirror room");
  row.count = device.counter(COUNT_PRIMARY);
  row.unit = "paths";
  row.exceptions = row.count - device.counter(COUNT_BOUNCE_LIMIT);
  row.remark = std::to_string(device.counter(COUNT_REFLECTED)) + " reflected rays";
  conclude(row);
}

/// A picture without environment under one light.
struct Lit {
  Image image;
  CaseRow row;
};

Lit lit_by(Scene scene, const SceneLight& light, const View& view, bool shadows,
           const std::string& compared) {
  scene.lights = {light};
  DeviceScene device(scene);
  Settings settings;
  settings.samples = 1;
  settings.shadows = shadows;
  Lit lit{device.render(view, settings, BLACK), {}};
  lit.row = device.row(compared);
  lit.row.count = lit.image.rgba.size();
  lit.row.unit = "pixels";
  return lit;
}

TEST(Shadow, TerminatorHasNoDarkFacets) {
  for (const bool even : {true, false}) {
    const Scene scene = scene_of({{sphere({.count = 20000, .even = even}, 1.0), test_material(0)}});
    const SceneLight light{LIGHT_DIRECTIONAL, glm::normalize(dvec3(1.0, 0.2, -0.2)), vec3(1.0F)};
    const View view{{.eye = {0.0, 0.0, 4.0}}, hard_width(256), hard_width(256)};
    const Lit with = lit_by(scene, light, view, true,
                            std::string("sphere lit sideways, ") + (even ? "even" : "random") +
                                " splats: pixels that shadow rays darken, convex shape");
    const Lit without = lit_by(scene, light, view, false, "");
    CaseRow row = with.row;
    float brightest = 0.0F;
    for (std::size_t i = 0; i < with.image.rgba.size(); ++i) {
      const float missing = without.image.rgba[i].x - with.image.rgba[i].x;
      row.exceptions += missing > 0.0F ? 1 : 0;
      brightest = std::max(brightest, missing);
    }
    row.remark = "brightest of them " + short_number(double(brightest));
    conclude(row);
  }
}

/// The square [-1, 1]^2 at y = 0, white and matte, seen from above; orthographic.
Scene white_floor() {
  Material white = test_material(0);
  white.phong.diffuse = vec3(1.0F);
  white.phong.specular = 0.0F;
  return scene_of({{rectangle({.count = 20000}, {-1, 0, 1}, {2, 0, 0}, {0, 0, -2}), white}});
}

View from_above() {
  View view{{.eye = {0.0, 3.0, 0.0}, .target = dvec3(0.0), .up = {0.0, 0.0, -1.0}},
            hard_width(128),
            hard_width(128)};
  view.camera.ortho_height = 1.6;
  return view;
}

/// Pixels of the floor that are not what a point light at this height over its middle gives.
CaseRow floor_lit_from(const Scene& scene, const dvec3& light, const std::string& compared) {
  const View view = from_above();
  Lit lit = lit_by(scene, {LIGHT_POINT, light, vec3(1.0F)}, view, true, compared);
  for (std::uint32_t i = 0; i < view.width * view.height; ++i) {
    const double x = ((i % view.width + 0.5) / view.width - 0.5) * view.camera.ortho_height;
    const double z = ((i / view.width + 0.5) / view.height - 0.5) * view.camera.ortho_height;
    const dvec3 to_light = light - dvec3(x, 0.0, z);
    const double distance = glm::length(to_light);
    const double expected = std::max(to_light.y, 0.0) / (distance * distance * distance) / M_PI;
    lit.row.exceptions += std::abs(double(lit.image.rgba[i].x) - expected) > 0.01 * expected + 1e-4 ? 1 : 0;
  }
  return lit.row;
}

TEST(Shadow, LightInAndBehindSplats) {
  const Scene scene = white_floor();
  const double radius = median_radius_root(scene) * scene.root.unit_world;
  const dvec3 aside(0.013, 0.0, 0.007);
  for (const double height_r : {10.0, 1.0, 0.1})
    conclude(floor_lit_from(scene, aside + dvec3(0.0, height_r * radius, 0.0),
                            "light " + short_number(height_r) + " r over a floor, exact irradiance"));
  for (const double height_r : {-0.1, -10.0})
    conclude(floor_lit_from(scene, aside + dvec3(0.0, height_r * radius, 0.0),
                            "light " + short_number(-height_r) + " r behind a floor: dark"));
  const dvec3 center = scene.root.to_world(unpack_splat(scene.data_pool[10000]).center);
  Lit lit = lit_by(scene, {LIGHT_POINT, center, vec3(1.0F)}, from_above(), true,
                   "light at a splat's centre: finite");
  conclude(lit.row);
}

/// A light behind another sheet must not shine through it, however near.
TEST(Shadow, LightBehindASheet) {
  SPLATRAY_NIGHTLY();
  Scene floor = white_floor();
  const double radius = median_radius_root(floor) * floor.root.unit_world;
  for (const double gap_r : {0.5, 3.0}) {
    const double height = 0.3;
    const OrientedPoints floor_points = rectangle({.count = 20000}, {-1, 0, 1}, {2, 0, 0}, {0, 0, -2});
    const OrientedPoints roof = rectangle({.count = 20000}, {-1, height, 1}, {0, 0, -2}, {2, 0, 0});
    const Scene scene =
        scene_of({{floor_points, test_material(0)}, {roof, test_material(MATERIAL_TWO_SIDED)}});
    View view = from_above();
    view.camera.eye.y = 0.5 * height;
    Lit lit = lit_by(scene, {LIGHT_POINT, {0.1, height + gap_r * radius, 0.1}, vec3(1.0F)}, view, true,
                     "light " + short_number(gap_r) + " r behind a roof: floor dark");
    for (const vec4& pixel : lit.image.rgba) lit.row.exceptions += pixel.x > 0.0F ? 1 : 0;
    conclude(lit.row);
  }
}

}  // namespace
}  // namespace splatray::testing
