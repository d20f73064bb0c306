#include "tests/scans/solids.h"

#include <algorithm>
#include <cmath>

namespace splatray::testing {
namespace {

constexpr double NEAREST = 1e-6;

void keep_nearer(SolidHit& hit, double t, const glm::dvec3& normal) {
  if (t > NEAREST && t < hit.t) hit = {t, normal};
}

void meet(const Ball& ball, const glm::dvec3& origin, const glm::dvec3& dir, SolidHit& hit) {
  const glm::dvec3 from = origin - ball.center;
  const double b = glm::dot(from, dir);
  const double root = b * b - glm::dot(from, from) + ball.radius * ball.radius;
  if (root < 0.0) return;
  for (const double t : {-b - std::sqrt(root), -b + std::sqrt(root)})
    keep_nearer(hit, t, glm::normalize(from + t * dir));
}

void meet(const Block& block, const glm::dvec3& origin, const glm::dvec3& dir, SolidHit& hit) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double plane : {block.low[axis], block.high[axis]}) {
      const double t = (plane - origin[axis]) / dir[axis];
      const glm::dvec3 place = origin + t * dir;
      bool within = true;
      for (int other = 0; other < 3; ++other)
        within = within &&
                 (other == axis || (place[other] >= block.low[other] && place[other] <= block.high[other]));
      glm::dvec3 normal(0.0);
      normal[axis] = 1.0;
      if (within) keep_nearer(hit, t, normal);
    }
  }
}

void meet(const Column3d& column, const glm::dvec3& origin, const glm::dvec3& dir, SolidHit& hit) {
  const glm::dvec2 from = glm::dvec2(origin) - column.center;
  const glm::dvec2 across(dir);
  const double a = glm::dot(across, across), b = glm::dot(from, across);
  const double root = b * b - a * (glm::dot(from, from) - column.radius * column.radius);
  if (root < 0.0 || a == 0.0) return;
  for (const double t : {(-b - std::sqrt(root)) / a, (-b + std::sqrt(root)) / a}) {
    const double z = origin.z + t * dir.z;
    const glm::dvec2 radial = from + t * across;
    if (z >= column.low && z <= column.high) keep_nearer(hit, t, glm::normalize(glm::dvec3(radial, 0.0)));
  }
}

void meet(const Terrain& terrain, const glm::dvec3& origin, const glm::dvec3& dir, SolidHit& hit) {
  constexpr double STEP = 0.05;
  const auto above = [&](double t) {
    const glm::dvec3 p = origin + t * dir;
    return p.z - 0.4 * std::sin(p.x) * std::cos(0.7 * p.y);
  };
  const double end = 4.0 * terrain.half;
  for (double t = STEP; t < end; t += STEP) {
    if ((above(t - STEP) > 0.0) == (above(t) > 0.0)) continue;
    double low = t - STEP, high = t;
    for (int i = 0; i < 50; ++i) {
      const double middle = 0.5 * (low + high);
      ((above(low) > 0.0) == (above(middle) > 0.0) ? low : high) = middle;
    }
    const glm::dvec3 p = origin + low * dir;
    if (std::abs(p.x) <= terrain.half && std::abs(p.y) <= terrain.half) {
      const glm::dvec3 normal(-0.4 * std::cos(p.x) * std::cos(0.7 * p.y),
                              0.28 * std::sin(p.x) * std::sin(0.7 * p.y), 1.0);
      keep_nearer(hit, low, glm::normalize(normal));
    }
    return;
  }
}

}  // namespace

SolidHit nearest_hit(const std::vector<Solid>& solids, const glm::dvec3& origin, const glm::dvec3& dir) {
  SolidHit hit;
  for (const Solid& solid : solids)
    std::visit([&](const auto& shape) { meet(shape, origin, dir, hit); }, solid);
  if (glm::dot(hit.normal, dir) > 0.0) hit.normal = -hit.normal;
  return hit;
}

std::vector<Solid> columned_room() {
  std::vector<Solid> solids{Block{{-4.0, -3.0, 0.0}, {4.0, 3.0, 3.0}}};
  for (const double x : {-2.0, 2.0})
    for (const double y : {-1.5, 1.5}) solids.emplace_back(Column3d{{x, y}, 0.3, 0.0, 3.0});
  return solids;
}

}  // namespace splatray::testing
