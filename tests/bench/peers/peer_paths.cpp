#include "tests/bench/peers/peer_paths.h"

#include <algorithm>
#include <array>

namespace splatray::testing {
namespace {

/// The paths of a bundle that still go on.
struct Paths {
  std::array<RayQuery, Peer::BUNDLE> rays;
  std::array<RayHit, Peer::BUNDLE> hits;
  std::array<std::size_t, Peer::BUNDLE> pixels;
  std::size_t count = 0;

  void trace(const Peer& peer) { peer.trace(std::span(rays).first(count), std::span(hits).first(count)); }
};

RayQuery leaving(const RayQuery& ray, const RayHit& hit, const vec3& dir, float lift) {
  RayQuery next{};
  next.origin = ray.origin + hit.t * ray.dir + lift * hit.normal;
  next.dir = dir;
  next.from_object = NO_OBJECT;
  return next;
}

void cast_shadows(const Peer& peer, const Paths& paths, const vec3& to_light, float lift,
                  std::vector<PathCount>& counts) {
  std::array<RayQuery, Peer::BUNDLE> rays;
  std::array<std::size_t, Peer::BUNDLE> pixels;
  std::array<std::uint8_t, Peer::BUNDLE> blocked;
  std::size_t count = 0;
  for (std::size_t i = 0; i < paths.count; ++i) {
    const RayHit& hit = paths.hits[i];
    if (hit.object == NO_OBJECT || glm::dot(hit.normal, to_light) <= 0.0F) continue;
    rays[count] = leaving(paths.rays[i], hit, to_light, lift);
    pixels[count++] = paths.pixels[i];
  }
  if (count == 0) return;
  peer.occluded(std::span(rays).first(count), std::span(blocked).first(count));
  for (std::size_t i = 0; i < count; ++i) counts[pixels[i]] = {1, blocked[i]};
}

/// Replaces the rays that hit by their mirrored ones, and drops the others.
void mirror(Paths& paths, float lift) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < paths.count; ++i) {
    const RayQuery ray = paths.rays[i];
    const RayHit& hit = paths.hits[i];
    if (hit.object == NO_OBJECT) continue;
    paths.rays[kept] = leaving(ray, hit, glm::reflect(ray.dir, hit.normal), lift);
    paths.pixels[kept++] = paths.pixels[i];
  }
  paths.count = kept;
}

}  // namespace

double trace_paths(const Peer& peer, const FrameParams& frame, unsigned threads, const PathRays& what,
                   std::vector<PathCount>& counts) {
  counts.assign(std::size_t{frame.width} * frame.height, {});
  return visit_bundles(frame, threads,
                       [&](std::span<const RayQuery> rays, std::span<const std::size_t> pixels) {
                         Paths paths;
                         paths.count = rays.size();
                         std::copy(rays.begin(), rays.end(), paths.rays.begin());
                         std::copy(pixels.begin(), pixels.end(), paths.pixels.begin());
                         paths.trace(peer);
                         if (what.to_light) cast_shadows(peer, paths, *what.to_light, what.lift, counts);
                         for (std::uint32_t bounce = 0; bounce < what.bounces; ++bounce) {
                           mirror(paths, what.lift);
                           if (paths.count == 0) return;
                           for (std::size_t i = 0; i < paths.count; ++i) ++counts[paths.pixels[i]].secondary;
                           paths.trace(peer);
                         }
                       });
}

}  // namespace splatray::testing
