#include "tests/hard/support/chains.h"

#include <algorithm>
#include <numeric>

#include "engine/scene/splat.h"
#include "tests/trace/rays.h"

namespace splatray::testing {
namespace {

using glm::dvec3;

constexpr std::size_t BATCH = std::size_t{1} << 18;

/// The rays of the segment that hit; shortens `index` with them.
Segment only_hits(const Segment& segment, std::vector<std::size_t>& index) {
  Segment kept;
  std::vector<std::size_t> kept_index;
  for (std::size_t i = 0; i < segment.rays.size(); ++i) {
    if (segment.hits[i].object == NO_OBJECT) continue;
    kept.rays.push_back(segment.rays[i]);
    kept.hits.push_back(segment.hits[i]);
    kept_index.push_back(index[i]);
  }
  index = std::move(kept_index);
  return kept;
}

}  // namespace

void in_batches(std::size_t total, const std::function<void(std::size_t, std::size_t)>& each) {
  for (std::size_t first = 0; first < total; first += BATCH) each(first, std::min(BATCH, total - first));
}

Segment traced(DeviceScene& device, std::vector<RayQuery> rays, const Settings& settings) {
  Segment segment{std::move(rays), {}};
  segment.hits = device.intersect(segment.rays, settings);
  return segment;
}

bool is_front(const RayQuery& ray, const RayHit& hit) {
  return glm::dot(unpack_splat(hit.first).normal, dvec3(ray.dir)) < 0.0;
}

std::vector<RayQuery> mirrored_rays(const Segment& segment, std::vector<std::size_t>& index) {
  const Segment hits = only_hits(segment, index);
  std::vector<RayQuery> next;
  next.reserve(hits.rays.size());
  for (std::size_t i = 0; i < hits.rays.size(); ++i) {
    const RayQuery& ray = hits.rays[i];
    const RayHit& hit = hits.hits[i];
    const dvec3 dir(ray.dir);
    const dvec3 normal = glm::normalize(dvec3(hit.normal));
    RayQuery out = primary_ray(dvec3(ray.origin) + double(hit.t) * dir, glm::reflect(dir, normal));
    out.inside = ray.inside;
    out.from_normal = is_front(ray, hit) ? hit.normal : -hit.normal;
    out.from_object = hit.object;
    next.push_back(out);
  }
  return next;
}

std::vector<RayQuery> refracted_rays(const Scene& scene, const Segment& segment,
                                     std::vector<std::size_t>& index) {
  const Segment hits = only_hits(segment, index);
  std::vector<TrueHit> as_truth;
  as_truth.reserve(hits.rays.size());
  for (std::size_t i = 0; i < hits.rays.size(); ++i) {
    TrueHit hit;
    hit.found = true;
    hit.t = hits.hits[i].t;
    hit.normal = glm::normalize(dvec3(hits.hits[i].normal));
    hit.object = hits.hits[i].object;
    hit.front = is_front(hits.rays[i], hits.hits[i]);
    as_truth.push_back(hit);
  }
  return secondary_rays(scene, hits.rays, as_truth, 1);
}

std::vector<std::size_t> indices(std::size_t count) {
  std::vector<std::size_t> result(count);
  std::iota(result.begin(), result.end(), std::size_t{0});
  return result;
}

}  // namespace splatray::testing
