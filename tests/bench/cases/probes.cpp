#include "tests/bench/cases/probes.h"

#include <random>

#include "tests/bench/cases/statistics.h"

namespace splatray::testing {
namespace {

using glm::dvec3;

constexpr double LEAST_COSINE = 0.2;
constexpr double BOUND = 1.05;       // radius of a sphere about both shapes
constexpr double JUMP_RADII = 0.01;  // how far a ray moves aside
constexpr double OTHER_RADII = 4.0;  // further off than this is another surface
constexpr double SAME_POINT = 1e-4;  // far below any disc's radius

/// A ray that enters the sphere of radius BOUND about the origin at a place uniform across its direction.
dvec3 entry(const dvec3& dir, std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const double across = std::sqrt(unit(random));
  const dvec3 offset = across * random_across(dir, random);
  return offset - std::sqrt(BOUND * BOUND - across * across) * dir;
}

/// Where the ray, as rounded, truly meets the shape; t in root units.
std::optional<ShapeHit> truth_of(Shape shape, const RootTransform& root, const RayQuery& query) {
  const dvec3 dir(query.dir);
  const double length = glm::length(dir);
  auto hit = first_hit(shape, root.to_world(dvec3(query.origin)), dir / length);
  if (hit) hit->t /= length * root.unit_world;
  return hit;
}

double cosine_of(const ShapeHit& hit, const RayQuery& query) {
  return -glm::dot(hit.normal, dvec3(query.dir));
}

/// A ray to the point from a random direction around its normal.
RayQuery second_ray(const dvec3& point_world, const dvec3& normal, const RootTransform& root,
                    std::mt19937_64& random) {
  dvec3 from = random_direction(random);
  while (glm::dot(from, normal) < LEAST_COSINE) from = random_direction(random);
  const double along = glm::dot(point_world, from);
  const double outside =
      std::sqrt(std::max(BOUND * BOUND - glm::dot(point_world, point_world) + along * along, 0.0)) - along;
  return primary_query(root.to_root(point_world + outside * from), -from);
}

bool is_hole(const RayHit& hit, const ShapeHit& truth, double radius_root) {
  return !(hit.t - truth.t <= OTHER_RADII * radius_root);
}

bool is_overhang(const RayHit& hit, const ShapeHit& truth, double radius_root) {
  return truth.t - hit.t > OTHER_RADII * radius_root;
}

bool is_same_surface(const RayHit& hit, const ShapeHit& truth, double radius_root) {
  return !is_hole(hit, truth, radius_root) && !is_overhang(hit, truth, radius_root);
}

}  // namespace

Probes::Probes(Shape shape, const RootTransform& root, std::size_t count, std::uint64_t seed) : root_(root) {
  std::mt19937_64 random(seed);
  while (rays_.size() < count) {
    const dvec3 dir = random_direction(random);
    const RayQuery ray = primary_query(root.to_root(entry(dir, random)), dir);
    const auto truth = truth_of(shape, root, ray);
    if (!truth || cosine_of(*truth, ray) < LEAST_COSINE) continue;
    const dvec3 point = dvec3(ray.origin) + truth->t * dvec3(ray.dir);
    const RayQuery second = second_ray(root.to_world(point), truth->normal, root, random);
    const auto second_truth = truth_of(shape, root, second);
    const dvec3 second_point =
        second_truth ? dvec3(second.origin) + second_truth->t * dvec3(second.dir) : dvec3(0.0);
    const bool seen = second_truth && glm::distance(point, second_point) * root.unit_world < SAME_POINT;
    rays_.push_back(ray);
    second_.push_back(second);
    probes_.push_back({random_across(dir, random), *truth, seen});
  }
}

ProbeErrors Probes::measure(const Intersect& intersect, double radius_world) const {
  const double radius_root = radius_world / root_.unit_world;
  std::vector<RayQuery> moved = rays_;
  for (std::size_t i = 0; i < moved.size(); ++i)
    moved[i].origin = dvec3(moved[i].origin) + JUMP_RADII * radius_root * probes_[i].aside;
  const std::vector<RayHit> hits = intersect(rays_);
  const std::vector<RayHit> moved_hits = intersect(moved);
  const std::vector<RayHit> second_hits = intersect(second_);

  std::vector<double> angles, jumps, inconsistencies, depths;
  std::uint64_t holes = 0, overhangs = 0;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const ShapeHit& truth = probes_[i].truth;
    const dvec3 normal(hits[i].normal);
    if (!is_same_surface(hits[i], truth, radius_root)) {
      ++(is_hole(hits[i], truth, radius_root) ? holes : overhangs);
      continue;
    }
    angles.push_back(angle_deg(normal, truth.normal));
    depths.push_back((hits[i].t - truth.t) / radius_root);
    if (is_same_surface(moved_hits[i], truth, radius_root))
      jumps.push_back(angle_deg(normal, dvec3(moved_hits[i].normal)));
    if (probes_[i].seen && second_hits[i].object != NO_OBJECT)
      inconsistencies.push_back(angle_deg(normal, dvec3(second_hits[i].normal)));
  }
  ProbeErrors errors;
  errors.normal_rms_deg = root_mean_square(angles);
  errors.jump_p999_deg = quantile(jumps, 0.999);
  errors.view_inconsistency_p99_deg = quantile(inconsistencies, 0.99);
  errors.depth_bias_r = mean(depths);
  errors.holes = wilson_share(holes, hits.size());
  errors.overhangs = wilson_share(overhangs, hits.size());
  errors.rays = hits.size();
  return errors;
}

}  // namespace splatray::testing
