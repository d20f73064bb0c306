#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "data/running_sum.h"
#include "data/shapes.h"

namespace splatray {
namespace {

using std::numbers::pi;

/// Areas of the cones between neighbouring parameters, summed.
std::vector<double> areas(const Profile& profile) {
  return running_sum([&](double from, double to) {
    const glm::dvec2 a = profile(from);
    const glm::dvec2 b = profile(to);
    return pi * (a.x + b.x) * glm::distance(a, b);
  });
}

}  // namespace

Profile spline(std::vector<glm::dvec2> points) {
  return [points = std::move(points)](double parameter) {
    const auto last = static_cast<int>(points.size()) - 1;
    const double along = std::clamp(parameter, 0.0, 1.0) * last;
    const int i = std::min(static_cast<int>(along), last - 1);
    const auto at = [&](int index) { return points[static_cast<std::size_t>(std::clamp(index, 0, last))]; };
    const glm::dvec2 slope = 0.5 * (at(i + 1) - at(i - 1));
    const glm::dvec2 next_slope = 0.5 * (at(i + 2) - at(i));
    const double t = along - i;
    const glm::dvec2 step = at(i + 1) - at(i);
    const glm::dvec2 place =
        at(i) +
        t * (slope + t * (3.0 * step - 2.0 * slope - next_slope + t * (slope + next_slope - 2.0 * step)));
    return glm::dvec2(std::max(0.0, place.x), place.y);
  };
}

OrientedPoints lathe(const Sampling& sampling, const Profile& profile) {
  constexpr double STEP = 1e-4;
  const std::vector<double> sums = areas(profile);
  OrientedPoints cloud;
  for (const glm::dvec2& uv : unit_square(sampling)) {
    const double parameter = parameter_at(sums, uv.x);
    const glm::dvec2 place = profile(parameter);
    const glm::dvec2 along =
        glm::normalize(profile(std::min(1.0, parameter + STEP)) - profile(std::max(0.0, parameter - STEP)));
    const double angle = 2.0 * pi * uv.y;
    const glm::dvec3 outwards(std::cos(angle), 0.0, -std::sin(angle));
    cloud.position.push_back(place.x * outwards + glm::dvec3(0.0, place.y, 0.0));
    cloud.normal.push_back(along.y * outwards - glm::dvec3(0.0, along.x, 0.0));
  }
  return cloud;
}

double lathe_area(const Profile& profile) { return areas(profile).back(); }

}  // namespace splatray
