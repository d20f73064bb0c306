#include "tests/bench/peers/peer_embree_clusters.h"

#include <algorithm>
#include <cassert>
#include <numeric>

namespace splatray::testing {
namespace {

/// What Embree hands to the intersection function: its own context, and the rays' gatherings.
struct ClusterTraversal {
  RTCIntersectContext context;
  Gathering* gathered;  ///< by the rays' ids
};

/// What of a ray is looked at.
RTCRay ray_of(RTCRayN* rays, unsigned count, unsigned lane) {
  RTCRay ray{};
  ray.org_x = RTCRayN_org_x(rays, count, lane);
  ray.org_y = RTCRayN_org_y(rays, count, lane);
  ray.org_z = RTCRayN_org_z(rays, count, lane);
  ray.tnear = RTCRayN_tnear(rays, count, lane);
  ray.dir_x = RTCRayN_dir_x(rays, count, lane);
  ray.dir_y = RTCRayN_dir_y(rays, count, lane);
  ray.dir_z = RTCRayN_dir_z(rays, count, lane);
  ray.tfar = RTCRayN_tfar(rays, count, lane);
  return ray;
}

/// Numbers of a disc that are tested.
constexpr std::size_t NUMBERS = 7;

/// How a ray meets the discs of a group.
struct Meetings {
  std::array<float, EmbreeClusters::GROUP_MOST> t;
  std::array<std::int32_t, EmbreeClusters::GROUP_MOST> met;  ///< 1 where the ray meets the disc, else 0
};

/// Where a ray meets the planes of a group's discs (EmbreeClusters::groups_), and whether on the disc within [tnear, tfar].
/// One clone for each width of vectors, chosen when the program starts, as Embree does. GCC makes scalar code of it where any
/// two of the lists might overlap.
[[gnu::target_clones("avx512f", "avx2", "default")]] void meet(const float* __restrict group,
                                                               std::size_t count, const RTCRay ray,
                                                               Meetings& __restrict meetings) {
  const float* __restrict center_x = group;
  const float* __restrict center_y = group + count;
  const float* __restrict center_z = group + 2 * count;
  const float* __restrict normal_x = group + 3 * count;
  const float* __restrict normal_y = group + 4 * count;
  const float* __restrict normal_z = group + 5 * count;
  const float* __restrict radius_squared = group + 6 * count;
  float* __restrict t_of = meetings.t.data();
  std::int32_t* __restrict met = meetings.met.data();
  for (std::size_t i = 0; i < count; ++i) {
    const float x = center_x[i] - ray.org_x;
    const float y = center_y[i] - ray.org_y;
    const float z = center_z[i] - ray.org_z;
    const float along = normal_x[i] * x + normal_y[i] * y + normal_z[i] * z;
    const float cosine = normal_x[i] * ray.dir_x + normal_y[i] * ray.dir_y + normal_z[i] * ray.dir_z;
    const float t = along / cosine;
    const float from_x = ray.dir_x * t - x;
    const float from_y = ray.dir_y * t - y;
    const float from_z = ray.dir_z * t - z;
    const float rho_squared = from_x * from_x + from_y * from_y + from_z * from_z;
    t_of[i] = t;
    met[i] =
        static_cast<std::int32_t>((rho_squared <= radius_squared[i]) & (t > ray.tnear) & (t <= ray.tfar));
  }
}

/// Puts discs of one group beside each other.
void fit(std::span<std::uint32_t> order, const std::vector<Disc>& discs, std::size_t group) {
  if (order.size() <= group) return;
  vec3 low(INFINITY), high(-INFINITY);
  for (const std::uint32_t disc : order) {
    low = glm::min(low, discs[disc].center);
    high = glm::max(high, discs[disc].center);
  }
  const vec3 size = high - low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
  const std::size_t groups = (order.size() + group - 1) / group;
  const std::size_t middle = groups / 2 * group;
  std::nth_element(
      order.begin(), order.begin() + std::ptrdiff_t(middle), order.end(),
      [&](std::uint32_t a, std::uint32_t b) { return discs[a].center[axis] < discs[b].center[axis]; });
  fit(order.first(middle), discs, group);
  fit(order.subspan(middle), discs, group);
}

std::vector<std::uint32_t> fitted_order(const std::vector<Disc>& discs, std::size_t group) {
  std::vector<std::uint32_t> order(discs.size());
  std::iota(order.begin(), order.end(), 0U);
  fit(order, discs, group);
  return order;
}

/// The discs as EmbreeClusters::groups_; the last group is filled up with discs that no ray meets.
std::vector<float> in_groups(const std::vector<Disc>& discs, const std::vector<std::uint32_t>& order,
                             std::size_t group) {
  const std::size_t places = (discs.size() + group - 1) / group * group;
  std::vector<float> groups(places * NUMBERS, -1.0F);
  for (std::size_t i = 0; i < discs.size(); ++i) {
    const auto& [center, radius, normal, object] = discs[order[i]];
    float* place = &groups[i / group * group * NUMBERS + i % group];
    for (const float number : {center.x, center.y, center.z, normal.x, normal.y, normal.z, radius * radius}) {
      *place = number;
      place += group;
    }
  }
  return groups;
}

}  // namespace

EmbreeClusters::EmbreeClusters(const Discs& discs, const Settings& settings, std::size_t group,
                               unsigned width, RTCBuildQuality quality)
    : discs_(discs),
      settings_(settings),
      group_(group),
      width_(width),
      order_(fitted_order(discs.list, group)),
      groups_(in_groups(discs.list, order_, group)),
      embree_(quality) {
  assert(group >= 1 && group <= GROUP_MOST && (width == 1 || width == 8 || width == 16));
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
    const Disc& disc = self.discs_.list[self.order_[i]];
    const vec3 reach = disc.radius * glm::sqrt(glm::max(vec3(1.0F) - disc.normal * disc.normal, vec3(0.0F)));
    lower = glm::min(lower, disc.center - reach);
    upper = glm::max(upper, disc.center + reach);
  }
  *args->bounds_o = {lower.x, lower.y, lower.z, 0.0F, upper.x, upper.y, upper.z, 0.0F};
}

template <class Visit>
void EmbreeClusters::visit_meetings(unsigned primitive, const RTCRay& ray, const Visit& visit) const {
  Meetings meetings;
  meet(&groups_[primitive * group_ * NUMBERS], group_, ray, meetings);
  const vec3 dir(ray.dir_x, ray.dir_y, ray.dir_z);
  for (std::size_t i = 0; i < group_; ++i) {
    if (meetings.met[i] == 0) continue;
    const std::size_t disc = order_[primitive * group_ + i];
    if (discs_.faces(disc, dir)) visit(disc, meetings.t[i]);
  }
}

void EmbreeClusters::intersect(const RTCIntersectFunctionNArguments* args) {
  const auto& self = *static_cast<const EmbreeClusters*>(args->geometryUserPtr);
  auto& traversal = *reinterpret_cast<ClusterTraversal*>(args->context);
  RTCRayN* rays = RTCRayHitN_RayN(args->rayhit, args->N);
  for (unsigned lane = 0; lane < args->N; ++lane) {
    if (args->valid[lane] == 0) continue;
    const RTCRay ray = ray_of(rays, args->N, lane);
    const vec3 dir(ray.dir_x, ray.dir_y, ray.dir_z);
    Gathering& gathered = traversal.gathered[RTCRayN_id(rays, args->N, lane)];
    self.visit_meetings(args->primID, ray, [&](std::size_t disc, float t) {
      gathered.add(disc, t, dir, self.discs_, self.settings_);
    });
    RTCRayN_tfar(rays, args->N, lane) = gathered.end();
  }
}

void EmbreeClusters::occlude(const RTCOccludedFunctionNArguments* args) {
  const auto& self = *static_cast<const EmbreeClusters*>(args->geometryUserPtr);
  for (unsigned lane = 0; lane < args->N; ++lane) {
    if (args->valid[lane] == 0) continue;
    self.visit_meetings(args->primID, ray_of(args->ray, args->N, lane),
                        [&](std::size_t, float) { RTCRayN_tfar(args->ray, args->N, lane) = -INFINITY; });
  }
}

template <unsigned WIDTH>
void EmbreeClusters::trace_together(std::span<const RayQuery> rays, std::span<RayHit> hits) const {
  std::array<Gathering, WIDTH> gathered;
  ClusterTraversal traversal{{}, gathered.data()};
  rtcInitIntersectContext(&traversal.context);
  traversal.context.flags = flags();
  if constexpr (WIDTH == 1) {
    RTCRayHit query = embree_ray(rays.front());
    rtcIntersect1(embree_.scene(), &traversal.context, &query);
  } else {
    EmbreeBundle<WIDTH>(rays).intersect(embree_.scene(), traversal.context);
  }
  for (std::size_t lane = 0; lane < rays.size(); ++lane)
    hits[lane] = gathered[lane].blended(rays[lane], discs_, settings_);
}

void EmbreeClusters::trace(std::span<const RayQuery> rays, std::span<RayHit> hits) const {
  for (std::size_t begin = 0; begin < rays.size(); begin += width_) {
    const std::size_t count = std::min<std::size_t>(width_, rays.size() - begin);
    const auto some = rays.subspan(begin, count);
    const auto answers = hits.subspan(begin, count);
    if (width_ == 1) trace_together<1>(some, answers);
    if (width_ == 8) trace_together<8>(some, answers);
    if (width_ == 16) trace_together<16>(some, answers);
  }
}

void EmbreeClusters::occluded(std::span<const RayQuery> rays, std::span<std::uint8_t> blocked) const {
  find_occluded(embree_.scene(), width_, flags(), rays, blocked);
}

std::uint64_t EmbreeClusters::bytes() const {
  return embree_.bytes() + sizeof(float) * groups_.size() + sizeof(std::uint32_t) * order_.size() +
         discs_.bytes();
}

}  // namespace splatray::testing
