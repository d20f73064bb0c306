#include "tests/hard/support/wedges.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "data/models.h"

namespace splatray::testing {
namespace {

using glm::dvec3;

const dvec3 AXIS(0.0, 0.0, 1.0);

}  // namespace

ExactWedge::ExactWedge(double angle_deg) : angle_deg_(angle_deg) {
  const double half = 0.5 * angle_deg * std::numbers::pi / 180.0;
  const dvec3 upper(std::cos(half), std::sin(half), 0.0);
  const dvec3 lower(std::cos(half), -std::sin(half), 0.0);
  mirrors_ = {Mirror{upper, glm::cross(upper, AXIS)}, Mirror{lower, glm::cross(AXIS, lower)}};
}

dvec3 ExactWedge::point(std::size_t mirror, double u, double v) const {
  return u * mirrors_[mirror].outwards + (v - 0.5) * AXIS;
}

ExactWedge::Path ExactWedge::trace(dvec3 origin, dvec3 dir) const {
  Path path;
  std::size_t left = mirrors_.size();
  for (;;) {
    std::size_t hit = mirrors_.size();
    double t_hit = INFINITY;
    for (std::size_t i = 0; i < mirrors_.size(); ++i) {
      const double cosine = glm::dot(dir, mirrors_[i].normal);
      path.least_cosine = std::min(path.least_cosine, std::abs(cosine));
      const double t = -glm::dot(origin, mirrors_[i].normal) / cosine;
      if (i == left || cosine >= 0.0 || t <= 0.0) continue;
      const dvec3 at = origin + t * dir;
      const double u = glm::dot(at, mirrors_[i].outwards);
      const double inside = std::min(1.0 - u, 0.5 - std::abs(at.z));
      if (inside > -0.5) path.corner_distance = std::min(path.corner_distance, std::abs(u));
      if (u > -0.5) path.border_distance = std::min(path.border_distance, std::abs(inside));
      if (u < 0.0 || inside < 0.0 || t >= t_hit) continue;
      t_hit = t;
      hit = i;
    }
    if (hit == mirrors_.size()) return path;
    origin += t_hit * dir;
    dir = glm::reflect(dir, mirrors_[hit].normal);
    left = hit;
    ++path.bounces;
  }
}

OrientedPoints ExactWedge::sampled(std::uint64_t count, bool even) const {
  return sample(models().at("wedge")({.angle_deg = angle_deg_}), {.count = count, .even = even}).at("wedge");
}

}  // namespace splatray::testing
