/// What the makers of rays for measuring share.
#pragma once
#include <functional>
#include <glm/glm.hpp>
#include <random>
#include <span>
#include <vector>

#include "shaders/layout.h"

namespace splatray::testing {

/// Answers rays of root space, one hit for each.
using Intersect = std::function<std::vector<RayHit>(std::span<const RayQuery>)>;

/// Uniform on the unit sphere.
[[nodiscard]] inline glm::dvec3 random_direction(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  const double x = normal(random), y = normal(random), z = normal(random);
  return glm::normalize(glm::dvec3(x, y, z));
}

/// Unit, at right angles to the unit vector `dir`, uniform around it.
[[nodiscard]] inline glm::dvec3 random_across(const glm::dvec3& dir, std::mt19937_64& random) {
  return glm::normalize(glm::cross(dir, random_direction(random)));
}

/// A primary ray, root space, rounded to float32.
[[nodiscard]] inline RayQuery primary_query(const glm::dvec3& origin_root, const glm::dvec3& dir) {
  RayQuery query{};
  query.origin = glm::vec3(origin_root);
  query.dir = glm::vec3(dir);
  query.from_object = NO_OBJECT;
  return query;
}

/// The mirrored ray from where a ray hit the front of a surface.
[[nodiscard]] inline RayQuery mirrored_query(const RayQuery& ray, const RayHit& hit) {
  const glm::dvec3 dir(ray.dir), normal(hit.normal);
  RayQuery query =
      primary_query(glm::dvec3(ray.origin) + double(hit.t) * dir, glm::normalize(glm::reflect(dir, normal)));
  query.from_normal = hit.normal;
  query.from_object = hit.object;
  return query;
}

}  // namespace splatray::testing
