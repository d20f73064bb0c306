#include <cmath>
#include <numbers>

#include "data/shapes.h"

namespace splatray {
namespace {

using std::numbers::pi;

/// Direction at `angle` from +x towards -z.
glm::dvec3 horizontal(double angle) { return {std::cos(angle), 0.0, -std::sin(angle)}; }

/// Torus area between tube angle 0 and `angle`, in units of 2 pi tube_radius.
double torus_area_to(double ring_radius, double tube_radius, double angle) {
  return ring_radius * angle + tube_radius * std::sin(angle);
}

}  // namespace

OrientedPoints sphere(const Sampling& sampling, double radius) {
  OrientedPoints cloud;
  for (const glm::dvec2& uv : unit_square(sampling)) {
    const double y = 1.0 - 2.0 * uv.x;
    const glm::dvec3 normal = std::sqrt(1.0 - y * y) * horizontal(2.0 * pi * uv.y) + glm::dvec3(0.0, y, 0.0);
    cloud.position.push_back(radius * normal);
    cloud.normal.push_back(normal);
  }
  return cloud;
}

OrientedPoints torus(const Sampling& sampling, double ring_radius, double tube_radius, double from,
                     double to) {
  const double area_from = torus_area_to(ring_radius, tube_radius, from);
  const double area_to = torus_area_to(ring_radius, tube_radius, to);
  OrientedPoints cloud;
  for (const glm::dvec2& uv : unit_square(sampling)) {
    const double area = area_from + uv.x * (area_to - area_from);
    double low = from;
    double high = to;
    for (int step = 0; step < 48; ++step) {
      const double middle = 0.5 * (low + high);
      (torus_area_to(ring_radius, tube_radius, middle) < area ? low : high) = middle;
    }
    const glm::dvec3 outwards = horizontal(2.0 * pi * uv.y);
    const glm::dvec3 normal = std::cos(low) * outwards + glm::dvec3(0.0, std::sin(low), 0.0);
    cloud.position.push_back(ring_radius * outwards + tube_radius * normal);
    cloud.normal.push_back(normal);
  }
  return cloud;
}

double torus_area(double ring_radius, double tube_radius, double from, double to) {
  return 2.0 * pi * tube_radius *
         (torus_area_to(ring_radius, tube_radius, to) - torus_area_to(ring_radius, tube_radius, from));
}

OrientedPoints disc(const Sampling& sampling, double radius) {
  OrientedPoints cloud;
  for (const glm::dvec2& uv : unit_square(sampling)) {
    cloud.position.push_back(radius * std::sqrt(uv.x) * horizontal(2.0 * pi * uv.y));
    cloud.normal.emplace_back(0.0, 1.0, 0.0);
  }
  return cloud;
}

OrientedPoints cylinder(const Sampling& sampling, double radius, double height, double from, double to) {
  OrientedPoints cloud;
  for (const glm::dvec2& uv : unit_square(sampling)) {
    const glm::dvec3 normal = horizontal(from + uv.y * (to - from));
    cloud.position.push_back(radius * normal + glm::dvec3(0.0, height * uv.x, 0.0));
    cloud.normal.push_back(normal);
  }
  return cloud;
}

}  // namespace splatray
