#include "tests/bench/truth/pixel_rays.h"

#include <cmath>
#include <numbers>

namespace splatray::testing {

PixelRays::PixelRays(const View& view) : eye_(view.camera.eye) {
  const glm::dvec3 to_target = view.camera.target - view.camera.eye;
  const glm::dvec3 forward = glm::normalize(to_target);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::normalize(view.camera.up)));
  const double pixel = 2.0 * std::tan(view.camera.fov_y_deg * std::numbers::pi / 360.0) / view.height;
  right_ = pixel * right;
  down_ = pixel * glm::cross(forward, right);
  corner_ = forward - 0.5 * (double(view.width) * right_ + double(view.height) * down_);
  pixel_width_ = pixel * glm::length(to_target);
}

glm::dvec3 PixelRays::dir_world(std::uint32_t x, std::uint32_t y) const {
  return glm::normalize(corner_ + (x + 0.5) * right_ + (y + 0.5) * down_);
}

}  // namespace splatray::testing
