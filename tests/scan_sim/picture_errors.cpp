#include "tests/scan_sim/picture_errors.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/trace/brute_force_tree.h"
#include "tests/trace/rays.h"

namespace splatray::testing {
namespace {

using glm::dvec3;

constexpr double FOV_DEG = 30.0;

double percentile(std::vector<double>& values, double share) {
  if (values.empty()) return 0.0;
  const auto nth =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

}  // namespace

PictureErrors picture_errors(const Scene& scene, const TriangleTree& truth, std::uint32_t size) {
  const BruteForceTree brute(scene);
  const dvec3 middle = 0.5 * (truth.low() + truth.high());
  const double diagonal = glm::length(truth.high() - truth.low());
  const double half = std::tan(FOV_DEG * std::numbers::pi / 360.0);
  std::vector<double> angles, depths;
  double beyond = 0.0, holes = 0.0;
  for (const double sign : {1.0, -1.0}) {
    const dvec3 eye =
        middle + dvec3(0.0, 0.0, sign * 0.5 * diagonal / std::sin(FOV_DEG * std::numbers::pi / 360.0));
    std::vector<RayQuery> rays;
    std::vector<dvec3> dirs;
    for (std::uint32_t y = 0; y < size; ++y) {
      for (std::uint32_t x = 0; x < size; ++x) {
        const auto across = [&](std::uint32_t pixel) { return half * (2.0 * (pixel + 0.5) / size - 1.0); };
        dirs.push_back(glm::normalize(dvec3(across(x), across(y), -sign)));
        RayQuery ray{};
        ray.origin = vec3(scene.root.to_root(eye));
        ray.dir = vec3(dirs.back());
        ray.from_object = NO_OBJECT;
        rays.push_back(ray);
      }
    }
    const std::vector<TrueHit> hits = all_nearest(brute, rays, Settings{});
    for (std::size_t i = 0; i < hits.size(); ++i) {
      const auto wanted = truth.first_hit(eye, dirs[i]);
      beyond += hits[i].found && !wanted ? 1.0 : 0.0;
      holes += !hits[i].found && wanted ? 1.0 : 0.0;
      if (!hits[i].found || !wanted) continue;
      const double cosine = glm::dot(glm::normalize(hits[i].normal), truth.smooth_normal(*wanted));
      angles.push_back(std::acos(std::clamp(cosine, -1.0, 1.0)) * 180.0 / std::numbers::pi);
      depths.push_back(std::abs(hits[i].t * scene.root.unit_world - wanted->distance) / diagonal);
    }
  }
  return {percentile(angles, 0.95), percentile(angles, 0.99), percentile(depths, 0.95),
          100.0 * beyond / (2.0 * size * size), 100.0 * holes / (2.0 * size * size)};
}

}  // namespace splatray::testing
