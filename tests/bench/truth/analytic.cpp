#include "tests/bench/truth/analytic.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "tests/bench/truth/pixel_rays.h"

namespace splatray::testing {
namespace {

using glm::dvec3;

/// Coefficients of 1, t, t^2, t^3, t^4.
using Quartic = std::array<double, 5>;

double value_at(const Quartic& f, double t) { return f[0] + t * (f[1] + t * (f[2] + t * (f[3] + t * f[4]))); }

Quartic derivative_of(const Quartic& f) { return {f[1], 2.0 * f[2], 3.0 * f[3], 4.0 * f[4], 0.0}; }

/// The root of f in [low, high], where f is monotone; nothing when its sign does not change.
std::optional<double> root_between(const Quartic& f, double low, double high) {
  const bool rises = value_at(f, low) <= 0.0;
  if (rises == (value_at(f, high) <= 0.0)) return {};
  for (int step = 0; step < 60; ++step) {
    const double middle = 0.5 * (low + high);
    ((value_at(f, middle) <= 0.0) == rises ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// Ascending roots of f of at most this degree in [low, high].
std::vector<double> roots(const Quartic& f, int degree, double low, double high) {
  if (degree == 0) return {};
  std::vector<double> ends = roots(derivative_of(f), degree - 1, low, high);
  ends.insert(ends.begin(), low);
  ends.push_back(high);
  std::vector<double> found;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i)
    if (const auto root = root_between(f, ends[i], ends[i + 1])) found.push_back(*root);
  return found;
}

/// (|p|^2 + R^2 - r^2)^2 - 4 R^2 (p.x^2 + p.z^2) along p = base + t dir, where base is perpendicular to dir.
Quartic torus_along(const dvec3& base, const dvec3& dir) {
  constexpr double R2 = TORUS_RING_RADIUS * TORUS_RING_RADIUS;
  constexpr double r2 = TORUS_TUBE_RADIUS * TORUS_TUBE_RADIUS;
  const double k = glm::dot(base, base) + R2 - r2;
  return {k * k - 4.0 * R2 * (base.x * base.x + base.z * base.z),
          -8.0 * R2 * (base.x * dir.x + base.z * dir.z), 2.0 * k - 4.0 * R2 * (dir.x * dir.x + dir.z * dir.z),
          0.0, 1.0};
}

dvec3 torus_normal(const dvec3& p) {
  const double across = std::hypot(p.x, p.z);
  const dvec3 ring_point(p.x / across * TORUS_RING_RADIUS, 0.0, p.z / across * TORUS_RING_RADIUS);
  return glm::normalize(p - ring_point);
}

}  // namespace

std::optional<ShapeHit> first_hit(Shape shape, const dvec3& origin, const dvec3& dir) {
  const double outer = shape == Shape::sphere ? SPHERE_RADIUS : TORUS_RING_RADIUS + TORUS_TUBE_RADIUS;
  const double nearest = -glm::dot(origin, dir);
  const dvec3 base = origin + nearest * dir;
  const double half_squared = outer * outer - glm::dot(base, base);
  if (half_squared < 0.0) return {};
  const double half = std::sqrt(half_squared);
  double t = -half;
  if (shape == Shape::torus) {
    const std::vector<double> found = roots(torus_along(base, dir), 4, -half - 1e-9, half + 1e-9);
    if (found.empty()) return {};
    t = found.front();
  }
  if (nearest + t <= 0.0) return {};
  const dvec3 p = base + t * dir;
  return ShapeHit{nearest + t, shape == Shape::sphere ? p / outer : torus_normal(p)};
}

Truth analytic_truth(Shape shape, const View& view) {
  const PixelRays rays(view);
  Truth truth{view.width, view.height, 0.0, {}};
  truth.pixels.resize(std::size_t{view.width} * view.height);
  for (std::uint32_t y = 0; y < view.height; ++y) {
    for (std::uint32_t x = 0; x < view.width; ++x) {
      const auto hit = first_hit(shape, rays.eye_world(), rays.dir_world(x, y));
      if (hit) truth.pixels[std::size_t{y} * view.width + x] = {hit->t, hit->normal};
    }
  }
  mark_edges(truth, JUMP_PIXELS * rays.pixel_width_world());
  return truth;
}

}  // namespace splatray::testing
