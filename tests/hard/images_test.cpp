// Windows of odd and extreme shapes, and many samples.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "data/shapes.h"
#include "tests/all_tests.h"
#include "tests/hard/support/clouds.h"
#include "tests/hard/support/device_scene.h"
#include "tests/trace/reference_path.h"

namespace splatray::testing {
namespace {

Scene lit_sphere() {
  Scene scene = scene_of({{sphere({.count = 500}, 1.0), test_material(0)}});
  scene.lights = {{LIGHT_DIRECTIONAL, glm::normalize(glm::dvec3(1.0)), vec3(2.0F)}};
  return scene;
}

TEST(Image, OddAndExtremeWindows) {
  const Scene scene = lit_sphere();
  const BruteForce brute(scene);
  const Environment grey{0, 0, {}, vec3(0.2F)};
  constexpr std::uint32_t SIZES[][2] = {{1, 1}, {1, 4096}, {4096, 1}, {1, 8191}, {8191, 1},
                                        {3, 5}, {127, 1},  {65, 33},  {641, 7},  {9, 1031}};
  DeviceScene device(scene);
  for (const auto& [width, height] : SIZES) {
    for (const std::uint32_t order : {ORDER_Z, ORDER_LINEAR}) {
      Settings settings;
      settings.samples = 2;
      settings.order = order;
      const View view{
          {.eye = {0.5, 0.3, 3.0}, .fov_y_deg = width == 1 ? 40.0 : 40.0 / std::max(1U, width / height)},
          width,
          height};
      const Image image = device.render(view, settings, grey);
      const Image reference = reference_picture(scene, brute, view, settings, grey);
      CaseRow row =
          device.row(std::to_string(width) + " x " + std::to_string(height) +
                     (order == ORDER_Z ? ", Z order" : ", rows") + ": picture, brute force in float64");
      row.count = image.rgba.size();
      row.unit = "pixels";
      for (std::size_t i = 0; i < image.rgba.size(); ++i)
        row.exceptions += glm::length(image.rgba[i] - reference.rgba[i]) > 0.004F ? 1 : 0;
      conclude(row);
    }
  }
}

/// Sums of many samples in float32 must not drift.
TEST(Image, ManySamples) {
  // Without the counters of DeviceScene, which cost a dispatch for each sample.
  ShownTracer tracer(shared_device());
  tracer.upload(scene_of({{sphere({.count = 500}, 1.0), test_material(0)}}));
  View view{{.eye = {5.0, 0.0, 0.0}, .target = {6.0, 0.0, 0.0}}, 8, 8};  // looks away: all is environment
  Settings settings;
  settings.samples = 65536;
  for (const float radiance : {1.0F, 0.1F, 1.0F / 3.0F}) {
    tracer.set_environment({0, 0, {}, vec3(radiance)});
    const Image image = tracer.render(view, settings);
    CaseRow row{.compared = "mean of 65 536 samples of radiance " + short_number(double(radiance)) +
                            ", within 1e-4 of it"};
    row.count = image.rgba.size();
    row.unit = "pixels";
    double worst = 0.0;
    for (const vec4& pixel : image.rgba) {
      const double error = std::abs(double(pixel.x) / double(radiance) - 1.0);
      row.exceptions += error <= 1e-4 ? 0 : 1;
      worst = std::max(worst, error);
    }
    row.remark = "largest relative error " + short_number(worst, 6);
    conclude(row);
  }
}

/// A dispatch of many long paths must not lose any: drivers may limit the loop iterations of an invocation.
TEST(Image, ManySamplesOfGlass) {
  SPLATRAY_NIGHTLY();
  ShownTracer tracer(shared_device());
  tracer.upload(scene_of({{sphere({.count = 20000}, 1.0), glass_material(1.5F)}}));
  tracer.set_environment({0, 0, {}, vec3(1.0F)});
  Settings settings;
  settings.samples = 1024;
  settings.max_bounces = 64;
  const Image image = tracer.render({{.eye = {0.0, 0.0, 3.0}}, 4, 4}, settings);
  CaseRow row{.compared = "mean of 1024 samples of a glass sphere in a white furnace, within 1e-4 of 1"};
  row.count = image.rgba.size();
  row.unit = "pixels";
  double worst = 0.0;
  for (const vec4& pixel : image.rgba) {
    const double error = std::abs(double(pixel.x) - 1.0);
    row.exceptions += error <= 1e-4 ? 0 : 1;
    worst = std::max(worst, error);
  }
  row.remark = "largest error " + short_number(worst);
  conclude(row);
}

}  // namespace
}  // namespace splatray::testing
