#include "tests/bench/peers/peer_discs.h"

#include <algorithm>
#include <cmath>

#include "engine/scene/splat.h"

namespace splatray::testing {
namespace {

/// The window grows as 1 / |n.d| up to this.
constexpr float MIN_COSINE = 0.1F;

float kernel_at(float u_squared, const Settings& settings) {
  if (settings.kernel == KERNEL_GAUSSIAN) return std::exp(-2.0F * u_squared);
  const float fall = std::max(1.0F - u_squared, 0.0F);
  return fall * fall;
}

/// 1 to the middle of the window, then smoothly to 0 at its end.
float fall_at(float share) {
  const float x = std::clamp(2.0F - 2.0F * share, 0.0F, 1.0F);
  return x * x * (3.0F - 2.0F * x);
}

vec3 against(const vec3& normal, const vec3& dir) { return glm::dot(normal, dir) > 0.0F ? -normal : normal; }

}  // namespace

bool Discs::any_one_sided() const {
  return std::any_of(two_sided.begin(), two_sided.end(), [](std::uint8_t flag) { return flag == 0; });
}

Discs discs_of(const Scene& scene) {
  Discs discs;
  for (std::size_t i = 0; i < scene.data_pool.size(); ++i) {
    const Splat splat = unpack_splat(scene.data_pool[i]);
    discs.list.push_back({vec3(splat.center), static_cast<float>(std::sqrt(splat.radius_squared)),
                          vec3(splat.normal), splat.object});
    if (scene.field_pool.empty()) continue;
    const glm::dmat3 field = unpack_field(scene.field_pool[i], splat.normal);
    discs.slope.push_back(
        {vec3(field[0][0], field[1][1], field[2][2]), vec3(field[1][2], field[0][2], field[0][1])});
  }
  for (const Material& material : scene.materials)
    discs.two_sided.push_back((material.flags & MATERIAL_TWO_SIDED) != 0 ? 1 : 0);
  return discs;
}

DiscFacet facet_of(const Discs& discs, std::size_t disc, float t, const vec3& from_center, const vec3& dir) {
  const vec3& plane_normal = discs.list[disc].normal;
  if (discs.slope.empty()) return {against(plane_normal, dir), t};
  const float cosine = glm::dot(plane_normal, dir);
  const vec3 lean = discs.slope[disc].times(from_center / discs.list[disc].radius);
  vec3 normal = glm::normalize(plane_normal + lean);
  if (cosine > 0.0F) normal = -normal;
  normal = glm::normalize(normal - dir * std::max(glm::dot(normal, dir), 0.0F));
  const float height = -0.5F * glm::dot(from_center, lean);
  return {normal, t + height / std::copysign(std::max(std::abs(cosine), MIN_COSINE), cosine)};
}

void Gathering::add(std::size_t disc, float t, const vec3& dir, const Discs& discs,
                    const Settings& settings) {
  if (t > end_) return;
  const Meeting meeting{t, static_cast<std::uint32_t>(disc)};
  if (t < first_.t) {
    first_ = meeting;
    const float cosine = std::abs(glm::dot(discs.list[disc].normal, dir));
    depth_ = settings.kappa * discs.list[disc].radius / std::max(cosine, MIN_COSINE);
    end_ = settings.blend == BLEND_NEAREST ? t : t + depth_;
  }
  if (settings.blend != BLEND_NEAREST && count_ < MOST) met_[count_++] = meeting;
}

RayHit Gathering::blended(const RayQuery& ray, const Discs& discs, const Settings& settings) const {
  RayHit hit{};
  hit.t = hit.t_first = first_.t;
  hit.object = NO_OBJECT;
  if (first_.t == INFINITY) return hit;
  hit.object = discs.list[first_.disc].object;
  const auto from_center_of = [&](const Meeting& meeting) {
    return ray.origin + meeting.t * ray.dir - discs.list[meeting.disc].center;
  };
  if (settings.blend == BLEND_NEAREST) {
    const DiscFacet facet = facet_of(discs, first_.disc, first_.t, from_center_of(first_), ray.dir);
    hit.normal = facet.normal;
    hit.t = facet.t;
    hit.members = 1;
    return hit;
  }
  const vec3 first_normal = against(discs.list[first_.disc].normal, ray.dir);
  vec3 normal_sum(0.0F);
  float weight_sum = 0.0F, depth_sum = 0.0F;
  for (std::size_t i = 0; i < count_; ++i) {
    const auto [t, disc] = met_[i];
    const float share = (t - first_.t) / depth_;
    const float like = glm::dot(against(discs.list[disc].normal, ray.dir), first_normal);
    if (share > 1.0F || discs.list[disc].object != hit.object || like <= 0.5F) continue;
    const vec3 from_center = from_center_of(met_[i]);
    const float radius = discs.list[disc].radius;
    const float u_squared = glm::dot(from_center, from_center) / (radius * radius);
    const float weight = std::max(kernel_at(u_squared, settings) * fall_at(share), 1.0F / 256.0F);
    const DiscFacet facet = facet_of(discs, disc, t, from_center, ray.dir);
    weight_sum += weight;
    depth_sum += weight * std::clamp(facet.t - first_.t, -depth_, depth_);
    normal_sum += weight * facet.normal;
    ++hit.members;
  }
  hit.t = first_.t + depth_sum / weight_sum;
  hit.normal = glm::normalize(normal_sum);
  return hit;
}

}  // namespace splatray::testing
