#include "tests/bench/peers/peer_embree_discs.h"

#include <cassert>
#include <cstddef>

namespace splatray::testing {
namespace {

/// What Embree hands to the filter: its own context, and the rays' gatherings.
struct Traversal {
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
  auto& traversal = *reinterpret_cast<Traversal*>(const_cast<RTCIntersectContext*>(args->context));
  for (unsigned lane = 0; lane < args->N; ++lane) {
    if (args->valid[lane] == 0) continue;
    const vec3 dir = dir_of(args, lane);
    const unsigned disc = RTCHitN_primID(args->hit, args->N, lane);
    Gathering& gathered = traversal.gathered[RTCRayN_id(args->ray, args->N, lane)];
    float& tfar = RTCRayN_tfar(args->ray, args->N, lane);
    if (traversal.discs.faces(disc, dir)) gathered.add(disc, tfar, dir, traversal.discs, traversal.settings);
    tfar = gathered.end();
  }
}

}  // namespace

EmbreeDiscs::EmbreeDiscs(const Discs& discs, const Settings& settings) : discs_(discs), settings_(settings) {
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

void EmbreeDiscs::trace(std::span<const RayQuery> rays, std::span<RayHit> hits) const {
  assert(rays.size() <= BUNDLE);
  Traversal traversal{{}, discs_, settings_, {}};
  rtcInitIntersectContext(&traversal.context);
  traversal.context.flags =
      coherent_ ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  EmbreeBundle bundle(rays);
  bundle.intersect(embree_.scene(), traversal.context);
  for (unsigned lane = 0; lane < rays.size(); ++lane) {
    Gathering& gathered = traversal.gathered[lane];
    if (settings_.blend == BLEND_NEAREST && bundle.query.hit.geomID[lane] != RTC_INVALID_GEOMETRY_ID)
      gathered.add(bundle.query.hit.primID[lane], bundle.query.ray.tfar[lane], rays[lane].dir, discs_,
                   settings_);
    hits[lane] = gathered.blended(rays[lane], discs_, settings_);
  }
}

void EmbreeDiscs::occluded(std::span<const RayQuery> rays, std::span<std::uint8_t> blocked) const {
  assert(rays.size() <= BUNDLE && blocked.size() == rays.size());
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = coherent_ ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  EmbreeBundle(rays).occluded(embree_.scene(), context, blocked);
}

}  // namespace splatray::testing
