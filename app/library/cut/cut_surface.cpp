#include "app/library/cut/cut_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/library/measure/least_squares.h"
#include "engine/scene/scene_splat.h"

namespace splatray {
namespace {

constexpr double SAME_SIDE = 0.866;      ///< least cosine between normals of one surface: 30 degrees
constexpr double THICKNESS = 1.0;        ///< radii of a splat that it is at most before or behind its surface
constexpr double LEAST_SINE = 0.26;      ///< between surface and plane
constexpr std::size_t LEAST_SPLATS = 6;  ///< that make a surface
/// What three further coefficients must explain of what is left, more than chance has: F of 3 and 20 to 60 degrees of freedom is
/// larger with a probability of about 1/200.
constexpr double SIGNIFICANT = 5.0;

struct Supporter {
  glm::dvec3 to;  ///< from the place to its centre
  double weight, radius;
};

/// A frame on the surface, lengths in it divided by `scale`.
struct Frame {
  glm::dvec3 normal, u, v;
  double scale;

  Frame(const glm::dvec3& n, double length) : normal(n), scale(length) {
    const glm::dvec3 any = std::abs(n.x) < 0.6 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
    u = glm::normalize(glm::cross(n, any));
    v = glm::cross(n, u);
  }
  template <std::size_t N>
  [[nodiscard]] std::array<double, N> row(const glm::dvec3& to) const {
    const double a = glm::dot(to, u) / scale, b = glm::dot(to, v) / scale;
    const std::array<double, 6> all{1.0, a, b, a * a, a * b, b * b};
    std::array<double, N> row{};
    std::copy_n(all.begin(), N, row.begin());
    return row;
  }
};

/// Height over the frame's origin, and its slopes along u and v.
struct Heights {
  double height, slope_u, slope_v;
  double squares;  ///< weighted sum of what is left
};

template <std::size_t N>
std::optional<Heights> fitted(const std::vector<Supporter>& near, const Frame& frame) {
  LeastSquares<N> sums;
  for (const Supporter& splat : near)
    sums.add(frame.row<N>(splat.to), glm::dot(splat.to, frame.normal), splat.weight);
  const auto solved = sums.solve();
  if (!solved) return {};
  Heights heights{(*solved)[0], (*solved)[1] / frame.scale, (*solved)[2] / frame.scale, 0.0};
  for (const Supporter& splat : near) {
    double left = glm::dot(splat.to, frame.normal);
    const std::array<double, N> row = frame.row<N>(splat.to);
    for (std::size_t i = 0; i < N; ++i) left -= row[i] * (*solved)[i];
    heights.squares += splat.weight * left * left;
  }
  return heights;
}

/// By a plane, or by a quadric where that leaves significantly less.
std::optional<Heights> heights_of(const std::vector<Supporter>& near, const Frame& frame) {
  const std::optional<Heights> plane = fitted<3>(near, frame);
  if (!plane) return {};
  double sum = 0.0, squares = 0.0;
  for (const Supporter& splat : near) {
    sum += splat.weight;
    squares += splat.weight * splat.weight;
  }
  const double freedom = sum * sum / squares - 6.0;  // of as many splats of equal weight
  if (freedom < 2.0) return plane;
  const std::optional<Heights> quadric = fitted<6>(near, frame);
  if (!quadric || (plane->squares - quadric->squares) / 3.0 <= SIGNIFICANT * quadric->squares / freedom)
    return plane;
  return quadric;
}

std::vector<Supporter> supporters(const CutSurface& surface, const CutPoint& at) {
  std::vector<Supporter> near;
  surface.for_each_near(at.place, [&](std::uint32_t index, const glm::dvec3& to) {
    const CutSplat& splat = surface.splats()[index];
    if (splat.object != at.object || glm::dot(splat.normal, at.normal) < SAME_SIDE) return;
    if (std::abs(glm::dot(to, at.normal)) > THICKNESS * splat.radius) return;
    const double most = CutSurface::SUPPORT * splat.radius, left = 1.0 - glm::dot(to, to) / (most * most);
    near.push_back({to, left * left, splat.radius});
  });
  return near;
}

/// Says of a point what follows from the splats around it.
void describe(const std::vector<Supporter>& near, CutPoint& point) {
  point.support = point.radius = 0.0;
  double ahead = std::numeric_limits<double>::infinity(), behind = ahead;
  const glm::dvec2 forward = point.forward();
  for (const Supporter& splat : near) {
    point.support += splat.weight;
    point.radius += splat.weight * splat.radius;
    double& nearest = glm::dot(glm::dvec2(splat.to), forward) >= 0.0 ? ahead : behind;
    nearest = std::min(nearest, glm::length(splat.to) / splat.radius);
  }
  point.radius /= point.support;
  point.gap = ahead + behind;
}

/// One step towards the surface; nothing where there is none.
std::optional<CutPoint> moved(const CutSurface& surface, const CutPoint& from) {
  const std::vector<Supporter> near = supporters(surface, from);
  if (near.size() < LEAST_SPLATS) return {};
  const Frame frame(from.normal, from.radius);
  const std::optional<Heights> heights = heights_of(near, frame);
  if (!heights) return {};
  CutPoint point = from;
  point.normal = glm::normalize(frame.normal - heights->slope_u * frame.u - heights->slope_v * frame.v);
  const glm::dvec2 across(point.normal);
  const double sine = glm::length(across);
  if (sine < LEAST_SINE) return {};
  const glm::dvec3 way(across / sine, 0.0);
  const double rise = glm::dot(way, frame.normal) - heights->slope_u * glm::dot(way, frame.u) -
                      heights->slope_v * glm::dot(way, frame.v);
  if (!(rise > 0.0)) return {};
  point.place += heights->height / rise * glm::dvec2(way);
  describe(near, point);
  return point;
}

}  // namespace

CutSurface::CutSurface(const Scene& scene, const CutPlane& plane) {
  const auto turned = [&plane](const glm::dvec3& v) {
    return glm::dvec3(glm::dot(v, plane.right), glm::dot(v, plane.top), glm::dot(v, plane.toward));
  };
  for_each_splat(scene, [&](std::size_t, const SceneSplat& splat) {
    const glm::dvec3 center = splat.center_world();
    const double height = glm::dot(center, plane.toward) - plane.near, radius = splat.radius_world();
    if (!(std::abs(height) < SUPPORT * radius)) return;
    const glm::dvec3 place = turned(center);
    splats_.push_back({{place.x, place.y, height}, turned(splat.normal()), radius, splat.object()});
  });
  for (std::uint32_t i = 0; i < splats_.size(); ++i) {
    const int level = std::ilogb(SUPPORT * splats_[i].radius) + 1;
    levels_[level][cell_of(glm::dvec2(splats_[i].center), level)].push_back(i);
  }
}

CutSurface::Cell CutSurface::cell_of(const glm::dvec2& place, int level) {
  const double side = std::ldexp(1.0, level);
  return {static_cast<std::int64_t>(std::floor(place.x / side)),
          static_cast<std::int64_t>(std::floor(place.y / side))};
}

std::optional<CutPoint> CutSurface::project(const CutPoint& guess) const {
  constexpr int STEPS = 6;
  constexpr double NEARLY = 1e-3, FARTHEST = 1.5;  // radii
  CutPoint at = guess;
  for (int step = 0; step < STEPS; ++step) {
    const std::optional<CutPoint> next = moved(*this, at);
    if (!next || glm::distance(next->place, guess.place) > FARTHEST * guess.radius) return {};
    const double by = glm::distance(next->place, at.place);
    at = *next;
    if (by < NEARLY * at.radius) break;
  }
  return at;
}

std::optional<CutPoint> CutSurface::project(const CutSplat& splat) const {
  const glm::dvec2 across(splat.normal);
  const double sine = glm::length(across), height = splat.center.z;
  if (sine < LEAST_SINE || std::abs(height) > splat.radius * sine) return {};
  const glm::dvec2 place = glm::dvec2(splat.center) + height * splat.normal.z / sine * across / sine;
  return project(CutPoint{place, splat.normal, splat.radius, splat.object});
}

}  // namespace splatray
