#include "tests/bench/truth/bounces.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "tests/bench/truth/analytic.h"

namespace splatray::testing {
namespace {

using glm::dvec3;

constexpr double BORDER_RADII = 3.0;
constexpr double MISSED_RADII = 2.0;
constexpr double TURN = 1e-3;            // of a ray by the rounding of normals in all its bounces, radians
constexpr double GRAZING_COSINE = TURN;  // of rays that may miss a mirror altogether

/// Two unit squares that meet in the z axis, open towards +x, facing each other.
struct Wedge {
  double half_angle;

  [[nodiscard]] dvec3 along(int side) const {
    return {std::cos(half_angle), (side == 0 ? 1.0 : -1.0) * std::sin(half_angle), 0.0};
  }
  [[nodiscard]] dvec3 normal(int side) const {
    return {std::sin(half_angle), (side == 0 ? -1.0 : 1.0) * std::cos(half_angle), 0.0};
  }
};

/// Where a ray meets the front of a mirror's plane: distance, place on the mirror's two edges, 0..1 on it, and cosine.
struct PlaneHit {
  double t, s, z, cosine;

  [[nodiscard]] bool inside() const { return s > 0.0 && s < 1.0 && z > 0.0 && z < 1.0; }
  /// Whether what is hit there depends on how the discs at the outer borders end, or on the rounding of normals.
  [[nodiscard]] bool at_border(double border) const {
    const double margin = border + TURN * t / cosine;
    const bool near = s > -margin && s < 1.0 + margin && z > -margin && z < 1.0 + margin;
    return near && (s > 1.0 - margin || z < margin || z > 1.0 - margin);
  }
};

std::optional<PlaneHit> plane_hit(const Wedge& wedge, int side, const dvec3& origin, const dvec3& dir) {
  const dvec3 normal = wedge.normal(side);
  const double towards = glm::dot(normal, dir);
  const double height = glm::dot(normal, origin);
  if (towards >= 0.0 || height <= 0.0) return {};
  const double t = -height / towards;
  const dvec3 point = origin + t * dir;
  return PlaneHit{t, glm::dot(point, wedge.along(side)), point.z + 0.5, -towards};
}

/// Whether the direction lies almost in a mirror, so that the rounding of its discs' normals decides what is hit.
bool grazes(const Wedge& wedge, const dvec3& dir) {
  return std::abs(glm::dot(dir, wedge.normal(0))) < GRAZING_COSINE ||
         std::abs(glm::dot(dir, wedge.normal(1))) < GRAZING_COSINE;
}

/// Bounces of the exact path; nothing when it comes near an outer border or grazes a mirror.
std::optional<std::uint32_t> exact_bounces(const Wedge& wedge, dvec3 origin, dvec3 dir, double margin) {
  int last = -1;
  for (std::uint32_t bounces = 0; bounces < MOST_BOUNCES; ++bounces) {
    if (grazes(wedge, dir)) return {};
    std::optional<PlaneHit> first;
    int first_side = 0;
    for (int side = 0; side < 2; ++side) {
      const auto hit = side == last ? std::nullopt : plane_hit(wedge, side, origin, dir);
      if (hit && hit->at_border(margin)) return {};
      if (!hit || !hit->inside() || (first && first->t <= hit->t)) continue;
      first = hit;
      first_side = side;
    }
    if (!first) return bounces;
    origin += first->t * dir;
    dir = glm::reflect(dir, wedge.normal(first_side));
    last = first_side;
  }
  return MOST_BOUNCES;
}

/// A ray from in front of the opening to a random point of one of the mirrors.
RayQuery ray_into(const Wedge& wedge, const RootTransform& root, std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const dvec3 target =
      unit(random) * wedge.along(unit(random) < 0.5 ? 0 : 1) + dvec3(0.0, 0.0, unit(random) - 0.5);
  const double angle = wedge.half_angle * (2.0 * unit(random) - 1.0);
  const dvec3 eye = 1.5 * dvec3(std::cos(angle), std::sin(angle), 0.0) + dvec3(0.0, 0.0, unit(random) - 0.5);
  return primary_query(root.to_root(eye), glm::normalize(target - eye));
}

/// Rays, and which path each belongs to.
struct Batch {
  std::vector<RayQuery> rays;
  std::vector<std::size_t> paths;
};

}  // namespace

Bounces wedge_bounces(const Intersect& intersect, const RootTransform& root, double wedge_deg,
                      double radius_world, std::size_t paths) {
  const Wedge wedge{0.5 * wedge_deg * std::numbers::pi / 180.0};
  std::mt19937_64 random(1);
  Batch batch;
  std::vector<std::uint32_t> exact, traced(paths, 0);
  while (batch.rays.size() < paths) {
    const RayQuery ray = ray_into(wedge, root, random);
    const auto bounces =
        exact_bounces(wedge, root.to_world(dvec3(ray.origin)), dvec3(ray.dir), BORDER_RADII * radius_world);
    if (!bounces) continue;
    batch.paths.push_back(batch.rays.size());
    batch.rays.push_back(ray);
    exact.push_back(*bounces);
  }
  for (std::uint32_t bounce = 0; bounce < MOST_BOUNCES && !batch.rays.empty(); ++bounce) {
    const std::vector<RayHit> hits = intersect(batch.rays);
    Batch next;
    for (std::size_t i = 0; i < hits.size(); ++i) {
      if (hits[i].object == NO_OBJECT) continue;
      ++traced[batch.paths[i]];
      next.paths.push_back(batch.paths[i]);
      next.rays.push_back(mirrored_query(batch.rays[i], hits[i]));
    }
    batch = std::move(next);
  }
  Bounces bounces{paths, 0};
  for (std::size_t i = 0; i < paths; ++i) bounces.wrong += traced[i] != exact[i] ? 1 : 0;
  return bounces;
}

Bounces ball_bounces(const Intersect& intersect, const RootTransform& root, double radius_world,
                     std::size_t paths) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<RayQuery> rays;
  for (std::size_t i = 0; i < paths; ++i) {
    const dvec3 start = 0.9 * SPHERE_RADIUS * std::cbrt(unit(random)) * random_direction(random);
    rays.push_back(primary_query(root.to_root(start), random_direction(random)));
  }
  Bounces bounces;
  for (std::uint32_t bounce = 0; bounce < MOST_BOUNCES; ++bounce) {
    const std::vector<RayHit> hits = intersect(rays);
    std::vector<RayQuery> next;
    for (std::size_t i = 0; i < hits.size(); ++i) {
      const dvec3 origin = root.to_world(dvec3(rays[i].origin)), dir(rays[i].dir);
      const double along = -glm::dot(origin, dir);
      const dvec3 base = origin + along * dir;
      const double exact_t =
          along + std::sqrt(std::max(SPHERE_RADIUS * SPHERE_RADIUS - glm::dot(base, base), 0.0));
      ++bounces.counted;
      const bool right = std::abs(hits[i].t * root.unit_world - exact_t) <= MISSED_RADII * radius_world;
      if (right) next.push_back(mirrored_query(rays[i], hits[i]));
      bounces.wrong += right ? 0 : 1;
    }
    rays = std::move(next);
  }
  return bounces;
}

}  // namespace splatray::testing
