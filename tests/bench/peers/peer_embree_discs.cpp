#include "tests/bench/peers/peer_embree_discs.h"

#include <algorithm>
#include <cassert>
#include <cstddef>

namespace splatray::testing {
namespace {

/// What Embree hands to the filter: its own context, and the rays' gatherings.
struct DiscTraversal {
  RTCIntersectContext context;
  const Discs& discs;
  const Settings& settings;
  std::array<Gathering, Peer::BUNDLE> gathered;
};

vec3 dir_of(const RTCFilterFunctionNArguments* args, unsigned lane) {
  return {RTCRayN_dir_x(args->ray, args->N, lane), RTCRayN_dir_y(args->ray, args->N, lane),
          RTCRayN_dir_z(args->ray, args->N, lane)};
}

/// BLEND_NEAREST, and rays that anything may end: rejects faces that do not count.
void cull(const RTCFilterFunctionNArguments* args) {
  const auto& discs = *static_cast<const Discs*>(args->geometryUserPtr);
  for (unsigned lane = 0; lane < args->N; ++lane)
    if (args->valid[lane] != 0 && !discs.faces(RTCHitN_primID(args->hit, args->N, lane), dir_of(args, lane)))
      args->valid[lane] = 0;
}

/// BLEND_WINDOW: notes the hit and accepts it with the window's end as the ray's.
void gather(const RTCFilterFunctionNArguments* args) {
  auto& traversal = *reinterpret_cast<DiscTraversal*>(const_cast<RTCIntersectContext*>(args->context));
  for (unsigned lane = 0; lane < args->N; ++lane) {
    if (args->valid[lane] == 0) continue;
    const vec3 dir = dir_of(args, lane);
    const unsigned disc = RTCHitN_primID(args->hit, args->N, lane);
    Gathering& gathered = traversal.gathered[args->N == 1 ? 0 : RTCRayN_id(args->ray, args->N, lane)];
    float& tfar = RTCRayN_tfar(args->ray, args->N, lane);
    if (traversal.discs.faces(disc, dir)) gathered.add(disc, tfar, dir, traversal.discs, traversal.settings);
    tfar = gathered.end();
  }
}

}  // namespace

EmbreeDiscs::EmbreeDiscs(const Discs& discs, const Settings& settings, unsigned width,
                         RTCBuildQuality quality)
    : discs_(discs), settings_(settings), width_(width), embree_(quality) {
  assert(width == 1 || width == 8 || width == 16);
  RTCGeometry geometry = rtcNewGeometry(embree_.device(), RTC_GEOMETRY_TYPE_ORIENTED_DISC_POINT);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, discs.list.data(),
                             offsetof(Disc, center), sizeof(Disc), discs.size());
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_NORMAL, 0, RTC_FORMAT_FLOAT3, discs.list.data(),
                             offsetof(Disc, normal), sizeof(Disc), discs.size());
  rtcSetGeometryUserData(geometry, const_cast<Discs*>(&discs_));
  if (settings.blend == BLEND_WINDOW) {
    rtcSetGeometryIntersectFilterFunction(geometry, gather);
  } else if (discs.any_one_sided()) {
    rtcSetGeometryIntersectFilterFunction(geometry, cull);
  }
  if (discs.any_one_sided()) rtcSetGeometryOccludedFilterFunction(geometry, cull);
  embree_.build(geometry);
}

void EmbreeDiscs::trace_alone(const RayQuery& ray, RayHit& hit) const {
  DiscTraversal traversal{{}, discs_, settings_, {}};
  rtcInitIntersectContext(&traversal.context);
  traversal.context.flags = flags();
  RTCRayHit query = embree_ray(ray);
  rtcIntersect1(embree_.scene(), &traversal.context, &query);
  Gathering& gathered = traversal.gathered[0];
  if (settings_.blend == BLEND_NEAREST && query.hit.geomID != RTC_INVALID_GEOMETRY_ID)
    gathered.add(query.hit.primID, query.ray.tfar, ray.dir, discs_, settings_);
  hit = gathered.blended(ray, discs_, settings_);
}

template <unsigned WIDTH>
void EmbreeDiscs::trace_together(std::span<const RayQuery> rays, std::span<RayHit> hits) const {
  DiscTraversal traversal{{}, discs_, settings_, {}};
  rtcInitIntersectContext(&traversal.context);
  traversal.context.flags = flags();
  EmbreeBundle<WIDTH> bundle(rays);
  bundle.intersect(embree_.scene(), traversal.context);
  for (unsigned lane = 0; lane < rays.size(); ++lane) {
    Gathering& gathered = traversal.gathered[lane];
    if (settings_.blend == BLEND_NEAREST && bundle.query.hit.geomID[lane] != RTC_INVALID_GEOMETRY_ID)
      gathered.add(bundle.query.hit.primID[lane], bundle.query.ray.tfar[lane], rays[lane].dir, discs_,
                   settings_);
    hits[lane] = gathered.blended(rays[lane], discs_, settings_);
  }
}

void EmbreeDiscs::trace(std::span<const RayQuery> rays, std::span<RayHit> hits) const {
  assert(rays.size() <= BUNDLE);
  for (std::size_t begin = 0; begin < rays.size(); begin += width_) {
    const std::size_t count = std::min<std::size_t>(width_, rays.size() - begin);
    if (width_ == 1) trace_alone(rays[begin], hits[begin]);
    if (width_ == 8) trace_together<8>(rays.subspan(begin, count), hits.subspan(begin, count));
    if (width_ == 16) trace_together<16>(rays.subspan(begin, count), hits.subspan(begin, count));
  }
}

void EmbreeDiscs::occluded(std::span<const RayQuery> rays, std::span<std::uint8_t> blocked) const {
  find_occluded(embree_.scene(), width_, flags(), rays, blocked);
}

}  // namespace splatray::testing
