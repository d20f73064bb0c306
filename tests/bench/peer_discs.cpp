#include "tests/bench/peer_discs.h"

#include <algorithm>
#include <cmath>

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
  for (const std::uint32_t reference : home_references(scene)) {
    const Splat splat = unpack_splat(scene.data_pool[reference]);
    discs.center_radius.emplace_back(vec3(splat.center), static_cast<float>(std::sqrt(splat.radius_squared)));
    discs.normal.emplace_back(splat.normal);
    discs.object.push_back(splat.object);
  }
  for (const Material& material : scene.materials)
    discs.two_sided.push_back((material.flags & MATERIAL_TWO_SIDED) != 0 ? 1 : 0);
  return discs;
}

void Gathering::add(std::size_t disc, float t, const vec3& dir, const Discs& discs,
                    const Settings& settings) {
  if (t > end_) return;
  const Meeting meeting{t, static_cast<std::uint32_t>(disc)};
  if (t < first_.t) {
    first_ = meeting;
    const float cosine = std::abs(glm::dot(discs.normal[disc], dir));
    depth_ = settings.kappa * discs.center_radius[disc].w / std::max(cosine, MIN_COSINE);
    end_ = settings.blend == BLEND_NEAREST ? t : t + depth_;
  }
  if (settings.blend != BLEND_NEAREST && count_ < MOST) met_[count_++] = meeting;
}

RayHit Gathering::blended(const RayQuery& ray, const Discs& discs, const Settings& settings) const {
  RayHit hit{};
  hit.t = hit.t_first = first_.t;
  hit.object = NO_OBJECT;
  if (first_.t == INFINITY) return hit;
  hit.object = discs.object[first_.disc];
  hit.members = 1;
  const vec3 first_normal = against(discs.normal[first_.disc], ray.dir);
  hit.normal = first_normal;
  if (settings.blend == BLEND_NEAREST) return hit;

  vec3 normal_sum(0.0F);
  float weight_sum = 0.0F, share_sum = 0.0F;
  hit.members = 0;
  for (std::size_t i = 0; i < count_; ++i) {
    const auto [t, disc] = met_[i];
    const vec3 normal = against(discs.normal[disc], ray.dir);
    const float share = (t - first_.t) / depth_;
    if (share > 1.0F || discs.object[disc] != hit.object || glm::dot(normal, first_normal) <= 0.5F) continue;
    const vec4& center_radius = discs.center_radius[disc];
    const vec3 from_center = ray.origin + t * ray.dir - vec3(center_radius);
    const float u_squared = glm::dot(from_center, from_center) / (center_radius.w * center_radius.w);
    const float weight = std::max(kernel_at(u_squared, settings) * fall_at(share), 1.0F / 256.0F);
    weight_sum += weight;
    share_sum += weight * share;
    normal_sum += weight * normal;
    ++hit.members;
  }
  hit.t = first_.t + depth_ * share_sum / weight_sum;
  hit.normal = glm::normalize(normal_sum);
  return hit;
}

}  // namespace splatray::testing
