// The shaders' maths of light, compiled as C++, against float64.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <random>

#include "engine/image/view.h"
#include "engine/scene/environment.h"
#include "tests/trace/light_twin.h"

namespace splatray::testing {
namespace {

class Directions {
 public:
  glm::dvec3 next() {
    const double z = 2.0 * uniform() - 1.0, turn = 2.0 * std::numbers::pi * uniform();
    const double across = std::sqrt(1.0 - z * z);
    return {across * std::cos(turn), across * std::sin(turn), z};
  }
  double uniform() { return std::uniform_real_distribution<double>()(random_); }

 private:
  std::mt19937 random_{5};
};

/// Fresnel's equations with a complex cosine behind the boundary, so that total reflection needs no case of its own.
double fresnel_share(double eta, double cosine) {
  const std::complex<double> behind =
      std::sqrt(std::complex<double>(1.0 - eta * eta * (1.0 - cosine * cosine)));
  const auto s = (eta * cosine - behind) / (eta * cosine + behind);
  const auto p = (cosine - eta * behind) / (cosine + eta * behind);
  return 0.5 * (std::norm(s) + std::norm(p));
}

TEST(LightMaths, FresnelsShare) {
  for (const double ior : {1.0, 1.0001, 1.33, 1.5, 2.42, 4.0})
    for (const double eta : {ior, 1.0 / ior})
      for (int i = 1; i <= 1000; ++i) {
        const float cosine = static_cast<float>(i) / 1000.0F;
        const float rounded_eta = static_cast<float>(eta);
        const TwinFresnel twin = twin_fresnel(rounded_eta, cosine);
        const double exact = fresnel_share(rounded_eta, cosine);
        // As far off as the share's own change for indices that differ by float32's rounding.
        const double change = std::abs(fresnel_share(rounded_eta * (1.0 + 2e-7), cosine) -
                                       fresnel_share(rounded_eta * (1.0 - 2e-7), cosine));
        EXPECT_NEAR(twin.share, exact, 1e-6 + 2.0 * change) << "eta " << eta << ", cosine " << cosine;
        EXPECT_GE(twin.share, 0.0F);
        EXPECT_LE(twin.share, 1.0F);
      }
  EXPECT_EQ(twin_fresnel(1.5F, 0.1F).share, 1.0F) << "total reflection";
  EXPECT_NEAR(twin_fresnel(1.0F / 1.5F, 1.0F).share, 0.04F, 1e-7F);
}

FrameParams frame_with_media(const std::vector<float>& iors) {
  FrameParams frame{};
  for (std::size_t bit = 0; bit < iors.size(); ++bit)
    frame.media[bit / 4][static_cast<int>(bit % 4)] = iors[bit];
  return frame;
}

TEST(LightMaths, MirroredAndRefractedDirectionsObeySnell) {
  Directions directions;
  Material glass{};
  glass.ior = 1.5F;
  glass.flags = MATERIAL_DIELECTRIC;
  const FrameParams frame = frame_with_media({1.5F});
  double worst = 0.0;
  for (int i = 0; i < 20000; ++i) {
    const bool front = i % 2 == 0;
    const vec3 dir = vec3(directions.next());
    vec3 normal = vec3(directions.next());
    if (glm::dot(normal, dir) > 0.0F) normal = -normal;
    const TwinRay ray{vec3(0.0F), dir, front ? 0U : 1U};
    const glm::dvec3 d = glm::normalize(glm::dvec3(dir)), n = glm::normalize(glm::dvec3(normal));

    const TwinCrossing mirrored = twin_crossing(frame, ray, normal, front, glass, 0.0F);
    EXPECT_TRUE(mirrored.reflected);
    EXPECT_EQ(mirrored.ray.inside, ray.inside);
    EXPECT_LT(glm::length(glm::dvec3(mirrored.ray.dir) - glm::reflect(d, n)), 1e-6);

    const double eta = front ? 1.0 / 1.5 : 1.5;
    const double sine_squared = eta * eta * (1.0 - glm::dot(n, d) * glm::dot(n, d));
    const TwinCrossing through = twin_crossing(frame, ray, normal, front, glass, 0.9999999F);
    EXPECT_TRUE(through.reflected || sine_squared < 1.0 + 1e-5) << "total reflection";
    if (through.reflected || sine_squared > 1.0 - 1e-3) continue;
    EXPECT_EQ(through.ray.inside, front ? 1U : 0U);
    const glm::dvec3 exact = eta * (d - glm::dot(n, d) * n) - std::sqrt(1.0 - sine_squared) * n;
    worst = std::max(worst, glm::length(glm::dvec3(through.ray.dir) - exact));
  }
  EXPECT_LT(worst, 2e-5);
  EXPECT_GT(worst, 0.0);
}

TEST(LightMaths, TheInnerOfTwoDielectricsDecides) {
  const FrameParams frame = frame_with_media({1.5F, 1.33F});
  Material outer{}, inner{};
  outer.flags = inner.flags = MATERIAL_DIELECTRIC;
  outer.ior = 1.5F;
  inner.ior = 1.33F;
  inner.mask_bit = 1;
  const vec3 normal(0.0F, 0.0F, 1.0F), dir = glm::normalize(vec3(0.5F, 0.0F, -1.0F));
  const double sine = 0.5 / std::sqrt(1.25);
  const auto sine_behind = [&](std::uint32_t inside, bool front, const Material& material) {
    return twin_crossing(frame, {vec3(0.0F), dir, inside}, normal, front, material, 0.9999F).ray.dir.x;
  };
  EXPECT_NEAR(sine_behind(0, true, outer), sine / 1.5, 1e-6) << "air to glass";
  EXPECT_NEAR(sine_behind(1, true, inner), sine * 1.5 / 1.33, 1e-6) << "glass to water within it";
  EXPECT_NEAR(sine_behind(3, false, inner), sine * 1.33 / 1.5, 1e-6) << "water to the glass around it";
  EXPECT_NEAR(sine_behind(3, false, outer), sine, 1e-6) << "the glass ends within the water: nothing changes";
}

TEST(LightMaths, PrimaryRaysAreThoseOfTheImagePlane) {
  Scene scene;
  scene.root.unit_world = 1e-6;
  scene.bounds_max_world = glm::dvec3(2.0);
  for (const double ortho_height : {0.0, 3.0}) {
    View view{{{5.0, 4.0, 7.0}, {1.0, 1.0, 1.0}, {0.1, 1.0, 0.0}, 35.0, ortho_height}, 640, 360};
    const FrameParams frame = make_frame_params(scene, view, {});
    const ImagePlane plane = image_plane(scene.root, view);
    for (const glm::dvec2 at :
         {glm::dvec2(0.5), glm::dvec2(320, 180), glm::dvec2(639.5, 0.25), glm::dvec2(17, 359.5)}) {
      const glm::dvec3 on_plane = plane.corner + at.x * plane.dx + at.y * plane.dy;
      const glm::dvec3 dir = glm::normalize(ortho_height > 0.0 ? plane.forward : plane.forward + on_plane);
      const glm::dvec3 through = ortho_height > 0.0 ? plane.eye + on_plane : plane.eye;
      const TwinRay ray = twin_primary_ray(frame, float(at.x), float(at.y));
      EXPECT_LT(glm::length(glm::dvec3(ray.dir) - dir), 5e-7);
      const glm::dvec3 apart = glm::dvec3(ray.origin) - through;
      EXPECT_LT(glm::length(apart - glm::dot(apart, dir) * dir), 2.0) << "lattice units beside the exact ray";
    }
  }
}

/// Longitude grows to the right about `up`, with the target's in the middle; the first row's top is straight up.
TEST(LightMaths, PrimaryRaysOfAPanoramaAreLongitudeAndLatitude) {
  Scene scene;
  scene.root.unit_world = 1e-6;
  scene.bounds_max_world = glm::dvec3(2.0);
  const glm::dvec3 eye(0.3, 0.4, 0.5), ahead = glm::normalize(glm::dvec3(3.0, 0.0, 4.0)), up(0.0, 1.0, 0.0);
  Camera camera{eye, eye + ahead + 0.7 * up, 2.0 * up};
  camera.panorama = true;
  const View view{camera, 4096, 2048};
  const FrameParams frame = make_frame_params(scene, view, {});
  for (double y = 0.25; y < view.height; y += 31.7)
    for (double x = 0.25; x < view.width; x += 63.3) {
      const double longitude = 2.0 * std::numbers::pi * (double(float(x)) / view.width - 0.5);
      const double latitude = std::numbers::pi * (0.5 - double(float(y)) / view.height);
      const glm::dvec3 level = std::cos(longitude) * ahead + std::sin(longitude) * glm::cross(ahead, up);
      const glm::dvec3 dir = std::cos(latitude) * level + std::sin(latitude) * up;
      const TwinRay ray = twin_primary_ray(frame, float(x), float(y));
      ASSERT_LT(glm::length(glm::dvec3(ray.dir) - dir), 5e-7) << x << ", " << y;
      ASSERT_LT(glm::length(scene.root.to_world(glm::dvec3(ray.origin)) - eye), 2e-6);
    }
}

TEST(LightMaths, PixelSamplesAreTheR2Sequence) {
  constexpr double PLASTIC = 1.32471795724474602596;  // x^3 = x + 1
  EXPECT_EQ(twin_pixel_sample(0), vec2(0.5F));
  for (std::uint32_t i = 0; i < 100000; i += 7) {
    const vec2 at = twin_pixel_sample(i);
    for (int axis = 0; axis < 2; ++axis) {
      const double exact = std::fmod(0.5 + i / std::pow(PLASTIC, axis + 1), 1.0);
      const double apart = std::abs(at[axis] - exact);
      EXPECT_LT(std::min(apart, 1.0 - apart), 3e-5) << i;  // 32-bit steps, i times rounded
      EXPECT_GE(at[axis], 0.0F);
      EXPECT_LT(at[axis], 1.0F);
    }
  }
}

TEST(LightMaths, PathNumbersFillTheUnitIntervalEvenly) {
  constexpr std::uint32_t SAMPLES = 1024;
  for (std::uint32_t pixel : {0U, 1U, 77777U}) {
    std::vector<double> numbers;
    for (std::uint32_t i = 0; i < SAMPLES; ++i) numbers.push_back(twin_path_random(pixel, i, 3, 1));
    std::sort(numbers.begin(), numbers.end());
    double widest = 1.0 - numbers.back() + numbers.front();
    for (std::size_t i = 1; i < numbers.size(); ++i) widest = std::max(widest, numbers[i] - numbers[i - 1]);
    EXPECT_LT(widest, 3.0 / SAMPLES)
        << "the golden ratio leaves gaps of three widths, the largest below 2.7 / N";
  }
  EXPECT_NE(twin_path_random(0, 0, 3, 1), twin_path_random(1, 0, 3, 1));
  EXPECT_NE(twin_path_random(0, 0, 3, 1), twin_path_random(0, 0, 4, 1));
  EXPECT_NE(twin_path_random(0, 0, 3, 1), twin_path_random(0, 0, 3, 2));
}

TEST(LightMaths, EnvironmentPositionsAreLatitudeAndLongitude) {
  Directions directions;
  for (int i = 0; i < 10000; ++i) {
    const glm::dvec3 dir = directions.next();
    const vec2 at = twin_environment_position(vec3(dir));
    const double turn = 2.0 * std::numbers::pi * (double(at.x) - 0.5), down = std::numbers::pi * double(at.y);
    const glm::dvec3 back(std::sin(down) * std::sin(turn), std::cos(down), -std::sin(down) * std::cos(turn));
    EXPECT_LT(glm::length(back - dir), 5e-6) << dir.x << ' ' << dir.y << ' ' << dir.z;
  }
}

TEST(LightMaths, DiffuseLightOfAnEnvironmentIsItsIntegral) {
  // Radiance that grows with height: of a + b y the irradiance / pi is a + 2/3 b n.y.
  Environment sky{256, 128, {}, {}};
  for (std::uint32_t row = 0; row < 128; ++row)
    for (std::uint32_t column = 0; column < 256; ++column)
      sky.texels.emplace_back(float(1.0 + 0.5 * std::cos(std::numbers::pi * (row + 0.5) / 128.0)));
  FrameParams frame{};
  frame.environment_up = {0.0F, 0.0F, 1.0F};
  frame.environment_right = {1.0F, 0.0F, 0.0F};
  const auto coefficients = irradiance_coefficients(sky);
  for (std::size_t i = 0; i < coefficients.size(); ++i) frame.irradiance[i] = vec4(coefficients[i], 0.0F);
  Directions directions;
  for (int i = 0; i < 1000; ++i) {
    const glm::dvec3 normal = directions.next();
    EXPECT_NEAR(twin_environment_diffuse(frame, vec3(normal)).y, 1.0 + normal.z / 3.0, 2e-4);
    const vec3 turned = twin_to_environment(frame, vec3(normal));
    EXPECT_NEAR(turned.y, normal.z, 1e-6);
    EXPECT_NEAR(turned.x, normal.x, 1e-6);
    EXPECT_NEAR(glm::length(turned), 1.0, 1e-6);
  }
}

}  // namespace
}  // namespace splatray::testing
