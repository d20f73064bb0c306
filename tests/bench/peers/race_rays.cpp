#include "tests/bench/peers/race_rays.h"

#include <random>

namespace splatray::testing {
namespace {

/// Rays that leave a surface on its front.
template <class Direction>
std::vector<RayQuery> rays_from(const std::vector<RayQuery>& primary, const std::vector<RayHit>& hits,
                                const Direction& direction) {
  std::vector<RayQuery> rays;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (hits[i].object == NO_OBJECT) continue;
    RayQuery ray = mirrored_query(primary[i], hits[i]);
    ray.dir = direction(ray);
    if (glm::dot(ray.dir, ray.from_normal) > 0.0F) rays.push_back(ray);
  }
  return rays;
}

/// The middle and the half size of the splats' box, root space.
std::pair<glm::dvec3, glm::dvec3> box_of(const Scene& scene) {
  const glm::dvec3 low = scene.root.to_root(scene.bounds_min_world),
                   high = scene.root.to_root(scene.bounds_max_world);
  return {0.5 * (low + high), 0.5 * (high - low)};
}

std::vector<RayQuery> random_rays(const Scene& scene, std::size_t count) {
  const auto [middle, half] = box_of(scene);
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> across(-1.0, 1.0);
  std::vector<RayQuery> rays;
  rays.reserve(count);
  while (rays.size() < count) {
    const glm::dvec3 from = middle + 1.5 * glm::length(half) * random_direction(random);
    const double x = across(random), y = across(random), z = across(random);
    rays.push_back(primary_query(from, glm::normalize(middle + half * glm::dvec3(x, y, z) - from)));
  }
  return rays;
}

}  // namespace

std::vector<RaceRays> race_rays(const Scene& scene, const std::vector<RayQuery>& primary,
                                const std::vector<RayHit>& hits) {
  const vec3 ahead = primary[primary.size() / 2].dir;
  const vec3 left = glm::normalize(glm::cross(vec3(0.0F, 1.0F, 0.0F), ahead));
  const vec3 to_light = glm::normalize(vec3(0.0F, 1.0F, 0.0F) + left - ahead);
  const std::vector<RayQuery> random = random_rays(scene, primary.size());
  std::vector<RaceRays> all;
  all.push_back({.kind = "frame", .samples = 1});
  all.push_back({.kind = "four", .samples = 4});
  all.push_back(
      {.kind = "mirrored", .list = rays_from(primary, hits, [](const RayQuery& ray) { return ray.dir; })});
  all.push_back({.kind = "random", .list = random, .coherent = false});
  all.push_back({.kind = "shadow",
                 .list = rays_from(primary, hits, [&](const RayQuery&) { return to_light; }),
                 .any = true});
  all.push_back({.kind = "occluded", .list = random, .any = true, .coherent = false});
  return all;
}

}  // namespace splatray::testing
