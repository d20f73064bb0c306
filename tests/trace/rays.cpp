#include "tests/trace/rays.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <thread>

namespace splatray::testing {
namespace {

using glm::dvec3;

dvec3 random_unit(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  return glm::normalize(dvec3(normal(random), normal(random), normal(random)));
}

/// Direction rounded to float32; its length is 1 to float32 rounding.
RayQuery query_of(dvec3 origin, dvec3 dir) {
  RayQuery query{};
  query.origin = vec3(origin);
  query.dir = vec3(glm::normalize(dir));
  query.from_object = NO_OBJECT;
  return query;
}

}  // namespace

std::vector<RayQuery> random_primary_rays(const Scene& scene, std::size_t count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const double edge = std::exp2(double(LATTICE_BITS));
  const dvec3 low = scene.root.to_root(scene.bounds_min_world);
  const dvec3 high = scene.root.to_root(scene.bounds_max_world);
  std::vector<RayQuery> rays;
  while (rays.size() < count) {
    const dvec3 eye = dvec3(edge / 2.0) + random_unit(random) * edge * (0.6 + 2.4 * unit(random));
    const dvec3 target = low + (high - low) * dvec3(unit(random), unit(random), unit(random));
    rays.push_back(query_of(eye, target - eye));
  }
  return rays;
}

std::vector<RayQuery> secondary_rays(const Scene& scene, const std::vector<RayQuery>& rays,
                                     const std::vector<TrueHit>& hits, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<RayQuery> next;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const TrueHit& hit = hits[i];
    if (!hit.found) continue;
    const Material& material = scene.materials[hit.object];
    const dvec3 dir(rays[i].dir);
    const double cosine = -glm::dot(dir, hit.normal);
    dvec3 out = next.size() % 2 == 0 ? dir + 2.0 * cosine * hit.normal : hit.normal + random_unit(random);
    std::uint32_t inside = rays[i].inside;
    if ((material.flags & MATERIAL_DIELECTRIC) != 0) {
      const double eta = hit.front ? 1.0 / double(material.ior) : double(material.ior);
      const double left = 1.0 - eta * eta * (1.0 - cosine * cosine);
      if (left > 0.0) out = eta * dir + (eta * cosine - std::sqrt(left)) * hit.normal;
      if (left > 0.0) inside ^= 1U << material.mask_bit;
      if (left <= 0.0) out = dir + 2.0 * cosine * hit.normal;
    }
    RayQuery query = query_of(dvec3(rays[i].origin) + hit.t * dir, out);
    query.inside = inside;
    query.from_normal = vec3(hit.front ? hit.normal : -hit.normal);
    query.from_object = hit.object;
    next.push_back(query);
  }
  return next;
}

std::vector<TrueHit> all_nearest(const BruteForce& brute, const std::vector<RayQuery>& rays,
                                 const Settings& settings) {
  std::vector<TrueHit> hits(rays.size());
  const std::size_t workers = std::max(1U, std::thread::hardware_concurrency());
  std::vector<std::jthread> threads;
  for (std::size_t worker = 0; worker < workers; ++worker) {
    threads.emplace_back([&, worker] {
      for (std::size_t i = worker; i < rays.size(); i += workers) hits[i] = brute.nearest(rays[i], settings);
    });
  }
  threads.clear();
  return hits;
}

}  // namespace splatray::testing
