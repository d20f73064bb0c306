#include "tests/bench/truth/shading.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "tests/bench/truth/pixel_rays.h"

namespace splatray::testing {
namespace {

constexpr double DIFFUSE = 0.7, AMBIENT = 0.1, SPECULAR = 0.2, SHININESS = 40.0, BACKGROUND = 0.18;
constexpr double LEFT = 35.0 * std::numbers::pi / 180.0, ABOVE = 45.0 * std::numbers::pi / 180.0;

/// Unit direction towards the light.
glm::dvec3 to_light(const Camera& camera) {
  const glm::dvec3 back = glm::normalize(camera.eye - camera.target);
  const glm::dvec3 right = glm::normalize(glm::cross(camera.up, back));
  const glm::dvec3 top = glm::cross(back, right);
  return std::cos(ABOVE) * (std::cos(LEFT) * back - std::sin(LEFT) * right) + std::sin(ABOVE) * top;
}

double phong(const glm::dvec3& normal, const glm::dvec3& dir, const glm::dvec3& light) {
  const double facing = std::max(glm::dot(normal, light), 0.0);
  const double along = std::max(glm::dot(glm::reflect(dir, normal), light), 0.0);
  return AMBIENT + DIFFUSE * facing + (facing > 0.0 ? SPECULAR * std::pow(along, SHININESS) : 0.0);
}

double encode(double linear) {
  const double clipped = std::clamp(linear, 0.0, 1.0);
  const double encoded =
      clipped <= 0.0031308 ? 12.92 * clipped : 1.055 * std::pow(clipped, 1.0 / 2.4) - 0.055;
  return std::round(255.0 * encoded) / 255.0;
}

}  // namespace

glm::vec3 srgb_8_bit(const glm::dvec3& linear) {
  return {static_cast<float>(encode(linear.x)), static_cast<float>(encode(linear.y)),
          static_cast<float>(encode(linear.z))};
}

std::vector<glm::vec3> shaded_picture(const View& view, const NormalAt& normal_at) {
  const PixelRays rays(view);
  const glm::dvec3 light = to_light(view.camera);
  std::vector<glm::vec3> picture;
  picture.reserve(std::size_t{view.width} * view.height);
  for (std::uint32_t y = 0; y < view.height; ++y) {
    for (std::uint32_t x = 0; x < view.width; ++x) {
      const auto normal = normal_at(x, y);
      const double value = normal ? phong(*normal, rays.dir_world(x, y), light) : BACKGROUND;
      picture.push_back(srgb_8_bit(glm::dvec3(value)));
    }
  }
  return picture;
}

double psnr_db(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b) {
  assert(a.size() == b.size() && !a.empty());
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const glm::dvec3 difference = glm::dvec3(a[i]) - glm::dvec3(b[i]);
    sum += glm::dot(difference, difference);
  }
  return 10.0 * std::log10(3.0 * static_cast<double>(a.size()) / sum);
}

}  // namespace splatray::testing
