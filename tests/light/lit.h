/// Small scenes under light, and what their pictures hold on the mean.
#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "data/shapes.h"
#include "engine/device/vulkan/vulkan_device.h"
#include "engine/image/picture_error.h"
#include "engine/scene/environment.h"
#include "tests/gpu/shown_tracer.h"
#include "tests/trace/scenes.h"

namespace splatray::testing {

using glm::dvec3;
using std::numbers::pi;

inline Material grey(float albedo) {
  Material material = test_material(MATERIAL_TWO_SIDED);
  material.phong.diffuse = vec3(albedo);
  material.phong.specular = material.phong.mirror = 0.0F;
  return material;
}

inline Environment constant(float radiance) { return {0, 0, {}, vec3(radiance)}; }

inline Settings lit(std::uint32_t samples) {
  Settings settings;
  settings.look = LOOK_LIT;
  settings.samples = samples;
  settings.max_bounces = 4096;
  settings.counters = true;
  return settings;
}

/// Mean of the red channel over pixels whose centre is covered, with its standard error.
struct Mean {
  double value = 0.0, error = 0.0;
};
inline Mean mean_of(const Image& image) {
  double sum = 0.0, squares = 0.0, count = 0.0;
  for (const vec4& pixel : image.rgba) {
    if (pixel.w < 1.0F) continue;
    sum += double(pixel.x);
    squares += double(pixel.x) * double(pixel.x);
    ++count;
  }
  const double mean = sum / count;
  return {mean, std::sqrt(std::max(squares / count - mean * mean, 0.0) / count)};
}

/// The relative error of a picture against a better one's pixels.
inline double error_against(Image image, const std::vector<vec4>& truth) {
  image.error = pixel_errors(image.rgba, truth);
  return relative_error(image);
}

/// Points on a ball.
inline OrientedPoints ball_at(const dvec3& center, double radius, std::size_t splats) {
  OrientedPoints points = sphere({.count = splats, .even = true, .seed = 5}, radius);
  for (dvec3& position : points.position) position += center;
  return points;
}

/// The device that light is tested on: Vulkan's, or what SPLATRAY_LIGHT_DEVICE names.
inline std::unique_ptr<Device> tested_device() {
  const char* wanted = std::getenv("SPLATRAY_LIGHT_DEVICE");
  return wanted == nullptr ? std::make_unique<VulkanDevice>() : open_device(wanted);
}

/// A scene on a device, and pictures of it.
class Lit : public ::testing::Test {
 protected:
  explicit Lit(std::unique_ptr<Device> device = tested_device()) : device_(std::move(device)) {}
  void show(const Scene& scene, const Environment& environment, const std::vector<SceneLight>& lights) {
    tracer_.upload(scene);
    tracer_.set_environment(environment);
    tracer_.look.lights = lights;
  }
  Image picture(const Camera& camera, const Settings& settings, std::uint32_t edge) {
    const Image image = tracer_.render({camera, edge, edge}, settings);
    EXPECT_EQ(tracer_.stats().counters[COUNT_NON_FINITE], 0U);
    EXPECT_EQ(tracer_.stats().counters[COUNT_LOST], 0U);
    return image;
  }
  void TearDown() override { EXPECT_EQ(device_->validation_messages(), 0U); }

  const std::unique_ptr<Device> device_;
  ShownTracer tracer_{*device_};
};

/// The same on the host, for paths of so many bounces that llvmpipe would cut a thread's loops.
class LitOnHost : public Lit {
 protected:
  LitOnHost() : Lit(open_device("cpu")) {}
};

/// A plane of splats, 4 x 4 in y = 0, seen from straight above at its middle.
class Plane : public Lit {
 protected:
  static TestObject floor() {
    const SurfacePatch patch =
        rectangle_surface("floor", {-2.0, 0.0, 2.0}, {4.0, 0.0, 0.0}, {0.0, 0.0, -4.0});
    return {patch.make({.count = 4000, .even = true}), grey(1.0F)};
  }
  Mean irradiance(const std::vector<SceneLight>& lights, std::uint32_t samples,
                  const Environment& environment = constant(0.0F)) {
    show(scene_of({floor()}), environment, lights);
    return irradiance_shown(samples);
  }
  Mean irradiance_shown(std::uint32_t samples) {
    const Camera above{dvec3(0.0, 1.5, 0.0), dvec3(0.0), dvec3(0.0, 0.0, -1.0), 30.0, 0.001};
    Settings settings = lit(samples);
    settings.max_bounces = bounces_;
    const Mean radiance = mean_of(picture(above, settings, 4));
    return {pi * radiance.value, pi * radiance.error};
  }

  std::uint32_t bounces_ = 4096;
};

}  // namespace splatray::testing
