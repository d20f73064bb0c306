// Rays of a tile's pixels, gathered at once, must have the bits of single rays: pictures with counters are traced ray by ray.
#include <gtest/gtest.h>

#include <random>

#include "data/shapes.h"
#include "engine/device/host/host_device.h"
#include "engine/scene/splat.h"
#include "tests/gpu/shown_tracer.h"
#include "tests/trace/scenes.h"

namespace splatray::testing {
namespace {

constexpr std::uint32_t NARROW_VECTOR_BITS[] = {256, 128, 32};

/// A ball of glass with colours in a box that is open to +z, points on its walls.
Scene ball_in_box() {
  std::vector<TestObject> objects{
      {painted(sphere({.count = 4000, .seed = 5}, 0.5),
               [](glm::dvec3 p) { return glm::dvec3(0.5 + 0.5 * p.x, 0.4, 0.2); }),
       test_material(MATERIAL_DIELECTRIC)}};
  const glm::dvec3 x(2.0, 0.0, 0.0), y(0.0, 2.0, 0.0), z(0.0, 0.0, 2.0), low(-1.0), high(1.0);
  for (const auto& [corner, a, b] : {std::tuple(low, z, x), std::tuple(low, x, y), std::tuple(low, y, z),
                                     std::tuple(high, -x, -z), std::tuple(high, -z, -y)})
    objects.push_back({painted(rectangle({.count = 1500}, corner, a, b),
                               [](glm::dvec3 p) { return glm::dvec3(0.3, 0.3 + 0.2 * p.y, 0.5); }),
                       test_material(MATERIAL_TWO_SIDED)});
  return scene_of(objects);
}

Camera camera(glm::dvec3 eye, glm::dvec3 target, double fov_y_deg = 40.0, double ortho_height = 0.0) {
  return {eye, target, {0.1, 1.0, 0.0}, fov_y_deg, ortho_height};
}

/// From outside, within, beside a wall, far and very far away, without perspective, of pixels below a lattice unit, and askew.
std::vector<Camera> cameras() {
  std::vector<Camera> all{camera({0.4, 0.3, 4.0}, {0.0, 0.0, 0.0}),
                          camera({0.9, 0.2, 0.3}, {-1.0, -0.1, 0.0}, 110.0),
                          camera({0.999, 0.999, 0.99}, {-1.0, 0.9, -1.0}, 150.0),
                          camera({0.0, 0.5001, 0.0}, {0.0, 0.0, 0.3}, 60.0),
                          camera({30.0, 10.0, 40.0}, {0.0, 0.0, 0.0}, 4.0),
                          camera({3e5, 1e5, 4e6}, {0.0, 0.0, 0.0}, 4e-5),
                          camera({0.5, 1.0, 3.0}, {0.0, 0.0, 0.0}, 40.0, 2.6),
                          camera({0.1, 0.1, 0.2}, {-1.0, 0.0, 0.1}, 40.0, 1.5),
                          camera({0.4, 0.3, 4.0}, {0.1, 0.2, 0.0}, 1e-4),
                          camera({0.4, 0.3, 4.0}, {0.1, 0.2, 0.0}, 40.0, 1e-5)};
  all.push_back(all.front());
  all.back().lens_shift = {0.4, -0.2};
  all.back().pixel_aspect = 3.0;
  return all;
}

/// From outside, within, and without perspective.
std::vector<Camera> some_cameras() {
  const std::vector<Camera> all = cameras();
  return {all[0], all[1], all[6]};
}

/// Pixels whose bits differ between tiles and single rays.
std::size_t different_pixels(ShownTracer& tracer, const View& view, Settings settings) {
  settings.aov = true;
  const Image tiles = tracer.render(view, settings);
  settings.counters = true;
  const Image single = tracer.render(view, settings);
  EXPECT_GT(tracer.stats().rays(), 0U);
  std::size_t different = 0;
  for (std::size_t i = 0; i < tiles.rgba.size(); ++i) {
    const AovPixel &a = tiles.aov[i], &b = single.aov[i];
    const bool same = std::memcmp(&tiles.rgba[i], &single.rgba[i], sizeof(vec4)) == 0 &&
                      a.normal == b.normal && a.z == b.z && a.object == b.object && a.splat == b.splat;
    different += same ? 0 : 1;
  }
  return different;
}

void expect_same_pictures(const Scene& scene, const std::vector<Camera>& cameras, const Settings& settings,
                          std::uint32_t vector_bits = UINT32_MAX) {
  const HostDevice device;
  ShownTracer tracer(device, {.vector_bits = vector_bits});
  tracer.upload(scene);
  for (std::size_t i = 0; i < cameras.size(); ++i)
    EXPECT_EQ(different_pixels(tracer, {cameras[i], 45, 35}, settings), 0U)
        << "camera " << i << ", vectors of " << vector_bits << " bits";
}

TEST(Tile, HasTheBitsOfSingleRays) {
  const Scene scene = ball_in_box();
  ASSERT_FALSE(scene.field_pool.empty());
  Settings settings;
  settings.samples = 2;
  expect_same_pictures(scene, cameras(), settings);
  for (const std::uint32_t bits : NARROW_VECTOR_BITS)
    expect_same_pictures(scene, some_cameras(), settings, bits);
  settings.samples = 20;
  expect_same_pictures(scene, some_cameras(), settings);
}

TEST(Tile, InEveryLookAndOrder) {
  const Scene scene = ball_in_box();
  Settings settings;
  settings.samples = 2;
  for (const std::uint32_t look : {LOOK_LIT, LOOK_AO, LOOK_SCAN, LOOK_BASE, LOOK_SEEN, LOOK_CLAY}) {
    settings.look = look;
    expect_same_pictures(scene, some_cameras(), settings);
  }
  settings.look = LOOK_PAPER;
  settings.order = ORDER_LINEAR;
  expect_same_pictures(scene, some_cameras(), settings);
}

/// Pixels that meet nothing get what is around without a ray.
TEST(Tile, EmptyPixelsShowWhatIsAround) {
  const Scene scene = ball_in_box();
  const HostDevice device;
  ShownTracer tracer(device);
  tracer.upload(scene);
  Environment bright{16, 8, {}, {}};
  for (std::uint32_t i = 0; i < 16 * 8; ++i)
    bright.texels.emplace_back(0.1F * static_cast<float>(i % 7), 0.3F, 0.01F * static_cast<float>(i));
  Settings settings;
  settings.samples = 20;
  for (const Environment& environment : {bright, Environment{0, 0, {}, glm::vec3(0.3F, 0.2F, 0.7F)}}) {
    tracer.set_environment(environment);
    for (const bool background : {false, true}) {
      settings.background.reset();
      if (background) settings.background = glm::vec3(0.1F, 0.9F, 0.3F);
      for (const Camera& camera : some_cameras())
        EXPECT_EQ(different_pixels(tracer, {camera, 45, 35}, settings), 0U) << "background " << background;
    }
  }
}

TEST(Tile, WithEveryBlendAndRegions) {
  const Scene scene = ball_in_box();
  Settings settings;
  settings.samples = 1;
  for (const std::uint32_t blend : {BLEND_NEAREST, BLEND_PAPER, BLEND_COUNT}) {
    settings.blend = blend;
    expect_same_pictures(scene, cameras(), settings);
  }
  settings.blend = BLEND_WINDOW;
  settings.region.kept.push_back({glm::dvec3(0.0, 0.1, 0.1), glm::dvec3(0.0, 0.6, 0.8)});
  expect_same_pictures(scene, cameras(), settings);
}

/// Splats of all sizes in a cloud that is looked at from within: some hold the eye, many pixels see to the end of the tree.
TEST(Tile, CloudsOfDiscsOfAllSizes) {
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal;
  OrientedPoints points;
  for (std::size_t i = 0; i < 5000; ++i) {
    points.position.emplace_back(normal(random), normal(random), normal(random));
    points.normal.push_back(glm::normalize(glm::dvec3(normal(random), normal(random), normal(random))));
  }
  Scene scene = scene_of({{points, test_material(MATERIAL_TWO_SIDED)}});
  std::uniform_real_distribution<double> exponent(std::log(2.0), std::log(3e5));
  for (uvec4& words : scene.data_pool.edit()) {
    Splat splat = unpack_splat(words);
    const double radius = std::exp(exponent(random));
    splat.radius_squared = radius * radius;
    words = pack_splat(splat);
  }
  scene.wide_nodes = {};
  Settings settings;
  settings.samples = 1;
  expect_same_pictures(scene, cameras(), settings);
}

/// More splats in a tile than its lists have room for.
TEST(Tile, ThatIsFullIsLeftToSingleRays) {
  OrientedPoints points;
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (std::size_t i = 0; i < 40000; ++i) {
    points.position.emplace_back(0.001 * unit(random), 0.001 * unit(random), unit(random));
    points.normal.push_back(glm::normalize(glm::dvec3(unit(random), unit(random), 0.5)));
  }
  points.position.emplace_back(1.0, 1.0, 0.0);
  points.normal.emplace_back(0.0, 0.0, 1.0);
  const Scene scene = scene_of({{points, test_material(MATERIAL_TWO_SIDED)}});
  Settings settings;
  settings.samples = 2;
  expect_same_pictures(scene, cameras(), settings);
}

}  // namespace
}  // namespace splatray::testing
