#include "tests/bench/peers/embree_scene.h"

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"

namespace splatray::testing {

EmbreeScene::EmbreeScene(RTCBuildQuality quality)
    : device_(rtcNewDevice(nullptr), rtcReleaseDevice), scene_(nullptr, rtcReleaseScene) {
  if (!device_) throw Error(ExitCode::failed, "Embree has no device on this machine");
  rtcSetDeviceMemoryMonitorFunction(device_.get(), count_bytes, this);
  scene_.reset(rtcNewScene(device_.get()));
  rtcSetSceneBuildQuality(scene_.get(), quality);
}

bool EmbreeScene::count_bytes(void* self, ssize_t bytes, bool /*after*/) {
  static_cast<EmbreeScene*>(self)->bytes_ += bytes;
  return true;
}

void EmbreeScene::build(RTCGeometry geometry) {
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene_.get(), geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene_.get());
  if (rtcGetDeviceError(device_.get()) != RTC_ERROR_NONE)
    throw Error(ExitCode::out_of_memory, "Embree could not build its data structure, expected memory enough");
}

RTCRayHit embree_ray(const RayQuery& query) {
  RTCRayHit ray{};
  ray.ray.org_x = query.origin.x;
  ray.ray.org_y = query.origin.y;
  ray.ray.org_z = query.origin.z;
  ray.ray.dir_x = query.dir.x;
  ray.ray.dir_y = query.dir.y;
  ray.ray.dir_z = query.dir.z;
  ray.ray.tnear = std::max(query.t_min, 0.0F);
  ray.ray.tfar = INFINITY;
  ray.ray.mask = ~0U;
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  return ray;
}

template <unsigned WIDTH>
EmbreeBundle<WIDTH>::EmbreeBundle(std::span<const RayQuery> rays) {
  for (unsigned lane = 0; lane < WIDTH; ++lane) {
    valid[lane] = lane < rays.size() ? -1 : 0;
    const RayQuery& ray = rays[std::min<std::size_t>(lane, rays.size() - 1)];
    query.ray.org_x[lane] = ray.origin.x;
    query.ray.org_y[lane] = ray.origin.y;
    query.ray.org_z[lane] = ray.origin.z;
    query.ray.dir_x[lane] = ray.dir.x;
    query.ray.dir_y[lane] = ray.dir.y;
    query.ray.dir_z[lane] = ray.dir.z;
    query.ray.tnear[lane] = std::max(ray.t_min, 0.0F);
    query.ray.tfar[lane] = INFINITY;
    query.ray.time[lane] = 0.0F;
    query.ray.mask[lane] = ~0U;
    query.ray.id[lane] = lane;
    query.ray.flags[lane] = 0;
    query.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
  }
}

template <unsigned WIDTH>
void EmbreeBundle<WIDTH>::intersect(RTCScene scene, RTCIntersectContext& context) {
  if constexpr (WIDTH == 8) rtcIntersect8(valid, scene, &context, &query);
  if constexpr (WIDTH == 16) rtcIntersect16(valid, scene, &context, &query);
}

template <unsigned WIDTH>
void EmbreeBundle<WIDTH>::occluded(RTCScene scene, RTCIntersectContext& context,
                                   std::span<std::uint8_t> blocked) {
  if constexpr (WIDTH == 8) rtcOccluded8(valid, scene, &context, &query.ray);
  if constexpr (WIDTH == 16) rtcOccluded16(valid, scene, &context, &query.ray);
  for (std::size_t lane = 0; lane < blocked.size(); ++lane)
    blocked[lane] = query.ray.tfar[lane] < 0.0F ? 1 : 0;
}

template struct EmbreeBundle<8>;
template struct EmbreeBundle<16>;

void find_occluded(RTCScene scene, unsigned width, RTCIntersectContextFlags flags,
                   std::span<const RayQuery> rays, std::span<std::uint8_t> blocked) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = flags;
  for (std::size_t begin = 0; begin < rays.size(); begin += width) {
    const std::size_t count = std::min<std::size_t>(width, rays.size() - begin);
    const auto some = rays.subspan(begin, count);
    const auto answers = blocked.subspan(begin, count);
    if (width == 8) EmbreeBundle<8>(some).occluded(scene, context, answers);
    if (width == 16) EmbreeBundle<16>(some).occluded(scene, context, answers);
    if (width != 1) continue;
    RTCRay ray = embree_ray(some.front()).ray;
    rtcOccluded1(scene, &context, &ray);
    answers.front() = ray.tfar < 0.0F ? 1 : 0;
  }
}

}  // namespace splatray::testing
