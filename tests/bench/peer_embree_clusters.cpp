#include "tests/bench/peer_embree_clusters.h"

#include <algorithm>
#include <cassert>

namespace splatray::testing {
namespace {

/// What Embree hands to the intersection function: its own context, and the ray's gathering.
struct Traversal {
  RTCIntersectContext context;
  vec3 dir;
  Gathering gathered;
};

/// A list per coordinate of a group's discs.
struct Lists {
  const float *center_x, *center_y, *center_z, *normal_x, *normal_y, *normal_z, *radius_squared;
};

/// How a ray meets the discs' planes: where, and how far beyond the rim (squared distance, > 0 outside).
struct Meetings {
  std::array<float, EmbreeClusters::GROUP_MOST> t;
  std::array<float, EmbreeClusters::GROUP_MOST> beyond;
};

/// One clone for each width of vectors, chosen when the program starts, as Embree does.
[[gnu::target_clones("avx512f", "avx2", "default")]] void meet(const Lists& discs, std::size_t count,
                                                               const vec3& origin, const vec3& dir,
                                                               Meetings& meetings) {
  for (std::size_t i = 0; i < count; ++i) {
    const float x = discs.center_x[i] - origin.x;
    const float y = discs.center_y[i] - origin.y;
    const float z = discs.center_z[i] - origin.z;
    const float along = discs.normal_x[i] * x + discs.normal_y[i] * y + discs.normal_z[i] * z;
    const float cosine = discs.normal_x[i] * dir.x + discs.normal_y[i] * dir.y + discs.normal_z[i] * dir.z;
    const float t = along / cosine;
    const float from_x = dir.x * t - x;
    const float from_y = dir.y * t - y;
    const float from_z = dir.z * t - z;
    meetings.t[i] = t;
    meetings.beyond[i] = from_x * from_x + from_y * from_y + from_z * from_z - discs.radius_squared[i];
  }
}

}  // namespace

EmbreeClusters::EmbreeClusters(const Discs& discs, const Settings& settings, std::size_t group)
    : discs_(discs), settings_(settings), group_(group) {
  assert(group >= 1 && group <= GROUP_MOST);
  for (std::size_t i = 0; i < discs.size(); ++i) {
    const vec4& disc = discs.center_radius[i];
    center_x_.push_back(disc.x);
    center_y_.push_back(disc.y);
    center_z_.push_back(disc.z);
    normal_x_.push_back(discs.normal[i].x);
    normal_y_.push_back(discs.normal[i].y);
    normal_z_.push_back(discs.normal[i].z);
    radius_squared_.push_back(disc.w * disc.w);
  }
  RTCGeometry geometry = rtcNewGeometry(embree_.device(), RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>((discs.size() + group - 1) / group));
  rtcSetGeometryUserData(geometry, this);
  rtcSetGeometryBoundsFunction(geometry, bounds_of, nullptr);
  rtcSetGeometryIntersectFunction(geometry, intersect);
  rtcSetGeometryOccludedFunction(geometry, occlude);
  embree_.build(geometry);
}

void EmbreeClusters::bounds_of(const RTCBoundsFunctionArguments* args) {
  const auto& self = *static_cast<const EmbreeClusters*>(args->geometryUserPtr);
  const std::size_t begin = args->primID * self.group_;
  vec3 lower(INFINITY), upper(-INFINITY);
  for (std::size_t i = begin; i < std::min(begin + self.group_, self.discs_.size()); ++i) {
    const vec3& normal = self.discs_.normal[i];
    const vec3 center(self.discs_.center_radius[i]);
    const vec3 reach =
        self.discs_.center_radius[i].w * glm::sqrt(glm::max(vec3(1.0F) - normal * normal, vec3(0.0F)));
    lower = glm::min(lower, center - reach);
    upper = glm::max(upper, center + reach);
  }
  *args->bounds_o = {lower.x, lower.y, lower.z, 0.0F, upper.x, upper.y, upper.z, 0.0F};
}

template <class Visit>
void EmbreeClusters::visit_meetings(unsigned primitive, RTCRayN* ray, const Visit& visit) const {
  const std::size_t begin = primitive * group_;
  const std::size_t count = std::min(group_, discs_.size() - begin);
  const Lists lists{&center_x_[begin], &center_y_[begin], &center_z_[begin],      &normal_x_[begin],
                    &normal_y_[begin], &normal_z_[begin], &radius_squared_[begin]};
  const vec3 origin(RTCRayN_org_x(ray, 1, 0), RTCRayN_org_y(ray, 1, 0), RTCRayN_org_z(ray, 1, 0));
  const vec3 dir(RTCRayN_dir_x(ray, 1, 0), RTCRayN_dir_y(ray, 1, 0), RTCRayN_dir_z(ray, 1, 0));
  const float tnear = RTCRayN_tnear(ray, 1, 0);
  Meetings meetings;
  meet(lists, count, origin, dir, meetings);
  for (std::size_t i = 0; i < count; ++i)
    if (meetings.beyond[i] <= 0.0F && meetings.t[i] > tnear && discs_.faces(begin + i, dir))
      visit(begin + i, meetings.t[i]);
}

void EmbreeClusters::intersect(const RTCIntersectFunctionNArguments* args) {
  assert(args->N == 1);
  if (args->valid[0] == 0) return;
  const auto& self = *static_cast<const EmbreeClusters*>(args->geometryUserPtr);
  auto& traversal = *reinterpret_cast<Traversal*>(args->context);
  RTCRayN* ray = RTCRayHitN_RayN(args->rayhit, 1);
  self.visit_meetings(args->primID, ray, [&](std::size_t disc, float t) {
    traversal.gathered.add(disc, t, traversal.dir, self.discs_, self.settings_);
  });
  RTCRayN_tfar(ray, 1, 0) = traversal.gathered.end();
}

void EmbreeClusters::occlude(const RTCOccludedFunctionNArguments* args) {
  assert(args->N == 1);
  if (args->valid[0] == 0) return;
  const auto& self = *static_cast<const EmbreeClusters*>(args->geometryUserPtr);
  self.visit_meetings(args->primID, args->ray,
                      [&](std::size_t, float) { RTCRayN_tfar(args->ray, 1, 0) = -INFINITY; });
}

void EmbreeClusters::trace(std::span<const RayQuery> rays, std::span<RayHit> hits) const {
  for (std::size_t i = 0; i < rays.size(); ++i) {
    Traversal traversal{{}, rays[i].dir, {}};
    rtcInitIntersectContext(&traversal.context);
    RTCRayHit query = embree_ray(rays[i]);
    rtcIntersect1(embree_.scene(), &traversal.context, &query);
    hits[i] = traversal.gathered.blended(rays[i], discs_, settings_);
  }
}

void EmbreeClusters::occluded(std::span<const RayQuery> rays, std::span<std::uint8_t> blocked) const {
  for (std::size_t i = 0; i < rays.size(); ++i) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay ray = embree_ray(rays[i]).ray;
    rtcOccluded1(embree_.scene(), &context, &ray);
    blocked[i] = ray.tfar < 0.0F ? 1 : 0;
  }
}

std::uint64_t EmbreeClusters::bytes() const {
  constexpr std::uint64_t LISTS = 7;
  return embree_.bytes() + LISTS * sizeof(float) * discs_.size() + discs_.bytes_of_fields();
}

}  // namespace splatray::testing
