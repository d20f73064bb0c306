#include <cmath>
#include <numbers>

#include "data/running_sum.h"
#include "data/shapes.h"

namespace splatray {
namespace {

using std::numbers::pi;
std::vector<double> arc_lengths(const Curve& curve) {
  return running_sum([&](double from, double to) { return glm::distance(curve(from), curve(to)); });
}

/// Angle about the curve up to which the share `fraction` of a ring's area lies, 0 being the side of the
/// centre of curvature; the area element is 1 - bend cos(angle), bend = tube radius * curvature < 1.
double ring_angle(double fraction, double bend) {
  double low = 0.0;
  double high = 2.0 * pi;
  for (int step = 0; step < 48; ++step) {
    const double middle = 0.5 * (low + high);
    (middle - bend * std::sin(middle) < 2.0 * pi * fraction ? low : high) = middle;
  }
  return low;
}

}  // namespace

OrientedPoints tube(const Sampling& sampling, const Curve& curve, double tube_radius) {
  const std::vector<double> lengths = arc_lengths(curve);
  constexpr double STEP = 1e-4;
  OrientedPoints cloud;
  for (const glm::dvec2& uv : unit_square(sampling)) {
    const double parameter = parameter_at(lengths, uv.x);
    const glm::dvec3 before = curve(parameter - STEP);
    const glm::dvec3 center = curve(parameter);
    const glm::dvec3 after = curve(parameter + STEP);
    const glm::dvec3 tangent = glm::normalize(after - before);
    const glm::dvec3 second = (after - 2.0 * center + before) / (STEP * STEP);
    const double speed = glm::length(after - before) / (2.0 * STEP);
    const glm::dvec3 curvature = (second - tangent * glm::dot(tangent, second)) / (speed * speed);
    const glm::dvec3 inwards = glm::normalize(curvature);
    const double angle = ring_angle(uv.y, tube_radius * glm::length(curvature));
    const glm::dvec3 normal = std::cos(angle) * inwards + std::sin(angle) * glm::cross(tangent, inwards);
    cloud.position.push_back(center + tube_radius * normal);
    cloud.normal.push_back(normal);
  }
  return cloud;
}

double tube_area(const Curve& curve, double tube_radius) {
  return 2.0 * pi * tube_radius * arc_lengths(curve).back();
}

glm::dvec3 trefoil(double parameter) {
  const double angle = 2.0 * pi * parameter;
  const double ring = 2.0 + std::cos(3.0 * angle);
  return glm::dvec3(ring * std::cos(2.0 * angle), ring * std::sin(2.0 * angle), std::sin(3.0 * angle)) / 3.0;
}

}  // namespace splatray
