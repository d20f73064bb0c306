#include <cmath>
#include <numbers>

#include "data/models.h"

namespace splatray {
namespace {

using std::numbers::pi;
const glm::dvec3 SIZE(4.0, 3.0, 5.0);  ///< m; the room's centre is the origin, so the floor is at y = -1.5

/// Red to the left, green to the right, a grey chequered floor, the rest nearly white.
glm::dvec3 room_paint(glm::dvec3 p) {
  constexpr double NEAR = 1e-6;
  if (p.x < -0.5 * SIZE.x + NEAR) return {0.33, 0.045, 0.035};
  if (p.x > 0.5 * SIZE.x - NEAR) return {0.05, 0.22, 0.065};
  if (p.y > -0.5 * SIZE.y + NEAR) return {0.42, 0.41, 0.385};
  const auto parity = static_cast<int>(std::floor(2.0 * p.x) + std::floor(2.0 * p.z)) & 1;
  return parity == 0 ? glm::dvec3(0.38) : glm::dvec3(0.10);
}

SurfacePatch ball_in_room(const std::string& object, double x, double z, double radius) {
  return {object, 4.0 * pi * radius * radius,
          [=](const Sampling& sampling) {
            return moved(sphere(sampling, radius), {x, radius - 0.5 * SIZE.y, z});
          },
          2.0};
}

}  // namespace

Model room_model() {
  Model model = box("room", SIZE, true);
  for (SurfacePatch& face : model) {
    face.make = [make = face.make](const Sampling& sampling) { return painted(make(sampling), room_paint); };
  }
  model.push_back(ball_in_room("matte", -1.1, -1.3, 0.60));
  model.push_back(ball_in_room("mirror", 0.40, -1.5, 0.75));
  model.push_back(ball_in_room("glass", 0.62, 0.15, 0.48));
  return model;
}

}  // namespace splatray
