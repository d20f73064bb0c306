#include "tests/trace/brute_force.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "engine/scene/splat.h"

namespace splatray::testing {
namespace {

using glm::dvec3;

constexpr std::size_t BLOCK = 256;

/// Order of splats met at the same t: by their words, most significant last (any fixed order would do).
auto order_of(const uvec4& w) { return std::make_tuple(w.w, w.z, w.x, w.y); }

double kernel_of(const Settings& settings, double u_squared) {
  if (settings.kernel == KERNEL_GAUSSIAN) return std::exp(-2.0 * u_squared);
  return std::pow(std::max(0.0, 1.0 - u_squared), 2.0);
}

double fall_of(double share) {
  if (share <= 0.5) return 1.0;
  const double x = std::clamp(2.0 * (1.0 - share), 0.0, 1.0);
  return 3.0 * x * x - 2.0 * x * x * x;
}

/// Whether a place, root space, is in the region of these planes, the first `kept` of which it has to be inside of.
bool is_in_region(const dvec3& place, const std::vector<vec4>& planes, std::size_t kept) {
  const auto inside = [&](const vec4& plane) { return glm::dot(dvec3(plane), place) > double(plane.w); };
  const auto kept_end = planes.begin() + static_cast<std::ptrdiff_t>(kept);
  const bool dropped = kept_end != planes.end() && std::all_of(kept_end, planes.end(), inside);
  return std::all_of(planes.begin(), kept_end, inside) && !dropped;
}

}  // namespace

BruteForce::BruteForce(const Scene& scene) : root_(scene.root), materials_(scene.materials) {
  clips_.assign(scene.clip_pool.begin(), scene.clip_pool.end());
  for (std::size_t i = 0; i < scene.data_pool.size(); ++i) {
    const uvec4& words = scene.data_pool[i];
    words_.push_back(words);
    splats_.push_back(unpack_splat(words));
    slopes_.push_back(scene.field_pool.empty() ? glm::dmat3(0.0)
                                               : unpack_field(scene.field_pool[i], splats_.back().normal));
    leans_.push_back(scene.field_pool.empty() ? dvec3(0.0)
                                              : unpack_lean(scene.field_pool[i], splats_.back().normal));
    if (!scene.color_pool.empty()) colors_.push_back(scene.color_pool[i]);
    x_.push_back(splats_.back().center.x);
    y_.push_back(splats_.back().center.y);
    z_.push_back(splats_.back().center.z);
    radius_squared_.push_back(splats_.back().radius_squared);
  }
}

void BruteForce::move_splat(std::size_t index, dvec3 by_root) {
  Splat& splat = splats_[index];
  splat.center += by_root;
  x_[index] = splat.center.x;
  y_[index] = splat.center.y;
  z_[index] = splat.center.z;
}

void BruteForce::turn_splat(std::size_t index, dvec3 by) {
  splats_[index].normal = glm::normalize(splats_[index].normal + by);
}

bool BruteForce::counts(const Meeting& meeting, const RayQuery& query, const Settings& settings) const {
  const Splat& splat = splats_[meeting.index];
  const Material& material = materials_[splat.object];
  if ((material.flags & MATERIAL_HIDDEN) != 0) return false;
  if (settings.side != SIDE_SIDE) return true;
  const bool cut_open = !settings.region.empty() && (material.flags & MATERIAL_DIELECTRIC) == 0;
  const bool two_sided = cut_open || (material.flags & MATERIAL_TWO_SIDED) != 0;
  const bool inside =
      (material.flags & MATERIAL_DIELECTRIC) != 0 && (query.inside & (1U << material.mask_bit)) != 0;
  if (!two_sided && (inside ? meeting.cosine <= 0.0 : meeting.cosine >= 0.0)) return false;
  if (query.from_object != splat.object) return true;
  constexpr double EDGE = 1U << LATTICE_BITS;
  const dvec3 from_middle = glm::abs(dvec3(query.origin) - dvec3(EDGE / 2.0));
  if (std::max({from_middle.x, from_middle.y, from_middle.z}) >= 1.5 * EDGE)
    return true;  // no sheet is there
  const dvec3 from_center = dvec3(query.origin) - splat.center;
  const double radius = std::sqrt(splat.radius_squared);
  const double like = glm::dot(splat.normal, dvec3(query.from_normal));
  const bool in_slab = std::abs(glm::dot(splat.normal, from_center)) < 0.5 * radius &&
                       glm::length(from_center) < 1.25 * radius && (two_sided ? std::abs(like) : like) > 0.5;
  constexpr double LEVEL = -1.0 / 4096.0;  // splat.glsl
  const bool leaves_upwards = glm::dot(dvec3(query.from_normal), dvec3(query.dir)) > LEVEL;
  const bool crosses_upwards = meeting.cosine > 0.0;
  const bool from_behind =
      leaves_upwards == crosses_upwards && glm::length(from_center) < 4.0 * radius && like > 0.5;
  return !(in_slab || from_behind);
}

bool BruteForce::is_ellipse(std::size_t index) const {
  return !clips_.empty() && clips_[index] / (1U << 24) < 127;
}

double BruteForce::rho_squared(std::size_t index, const dvec3& from_center) const {
  const double of_disc = glm::dot(from_center, from_center);
  if (!is_ellipse(index)) return of_disc;
  const int code = static_cast<int>(clips_[index] / (1U << 23));
  const double factor = (8.0 + code % 8) * std::pow(2.0, code / 8 - 45);
  const double along =
      glm::dot(across(index, static_cast<int>(clips_[index] / (1U << 16) % 128)), from_center);
  return of_disc + factor * along * along;
}

dvec3 BruteForce::across(std::size_t index, int direction) const {
  dvec3 stored =
      splats_[index].normal;  // of length 1: brought to the stored length, |x| + |y| + |z| = OCT_SCALE
  stored = glm::round(stored *
                      (double(OCT_SCALE) / (std::abs(stored.x) + std::abs(stored.y) + std::abs(stored.z))));
  glm::length_t axis = 0;
  for (glm::length_t i = 1; i < 3; ++i)
    if (std::abs(stored[i]) < std::abs(stored[axis])) axis = i;
  dvec3 unit(0.0);
  unit[axis] = 1.0;
  const double a = std::abs(128 - direction) - 64, b = std::abs(128 - ((direction + 192) & 255)) - 64;
  return a * glm::cross(unit, stored) + b * double(OCT_SCALE) * unit;
}

bool BruteForce::kept(std::size_t index, const dvec3& from_center) const {
  if (clips_.empty()) return true;
  const Splat& splat = splats_[index];
  int exponent = 0;
  std::frexp(splat.radius_squared, &exponent);  // r^2 < 2^exponent
  const double bound = std::exp2(std::ceil(exponent / 2.0));
  const int lines = is_ellipse(index) ? 1 : 2;
  for (int number = 0; number < lines; ++number) {
    const std::uint32_t line = clips_[index] >> 16 * number & 0xFFFFU;
    const double limit = (static_cast<double>(line >> 8) - 127.0) * bound * OCT_SCALE / 2.0;
    if (glm::dot(across(index, static_cast<int>(line & 0xFFU)), from_center) > limit) return false;
  }
  return true;
}

void BruteForce::find_near(const RayQuery& query, std::vector<std::uint32_t>& near) const {
  const dvec3 origin(query.origin);
  const dvec3 dir(query.dir);
  const double inverse_dir_squared = 1.0 / glm::dot(dir, dir);
  std::array<double, BLOCK> beyond{};
  near.clear();
  for (std::size_t begin = 0; begin < splats_.size(); begin += BLOCK) {
    const std::size_t size = std::min(BLOCK, splats_.size() - begin);
    for (std::size_t i = 0; i < size; ++i) {
      const double x = x_[begin + i] - origin.x;
      const double y = y_[begin + i] - origin.y;
      const double z = z_[begin + i] - origin.z;
      const double along = x * dir.x + y * dir.y + z * dir.z;
      beyond[i] = x * x + y * y + z * z - along * along * inverse_dir_squared -
                  (radius_squared_[begin + i] * 1.001 + 1.0);
    }
    for (std::size_t i = 0; i < size; ++i)
      if (!(beyond[i] > 0.0)) near.push_back(static_cast<std::uint32_t>(begin + i));
  }
}

std::vector<BruteForce::Meeting> BruteForce::meetings(const RayQuery& query, const Settings& settings) const {
  const dvec3 origin(query.origin);
  const dvec3 dir(query.dir);
  thread_local std::vector<std::uint32_t> near;
  find_near(query, near);
  const std::vector<vec4> planes = region_planes(root_, settings.region);
  std::vector<Meeting> found;
  for (const std::uint32_t index : near) {
    const Splat& splat = splats_[index];
    const double cosine = glm::dot(splat.normal, dir);
    const double t = glm::dot(splat.normal, splat.center - origin) / cosine;
    const dvec3 from_center = origin + t * dir - splat.center;
    const double rho_squared = this->rho_squared(index, from_center);
    if (!(rho_squared <= splat.radius_squared) || !(t > double(query.t_min)) || !std::isfinite(t)) continue;
    if (!kept(index, from_center)) continue;
    if (!planes.empty() && !is_in_region(origin + t * dir, planes, settings.region.kept.size())) continue;
    const Meeting meeting{t, rho_squared / splat.radius_squared, cosine, index};
    if (counts(meeting, query, settings)) found.push_back(meeting);
  }
  return found;
}

std::vector<std::uint32_t> BruteForce::objects_met(const RayQuery& query, const Settings& settings,
                                                   double t_max) const {
  std::vector<std::uint32_t> objects;
  for (const Meeting& meeting : meetings(query, settings))
    if (meeting.t < t_max) objects.push_back(splats_[meeting.index].object);
  return objects;
}

BruteForce::Facet BruteForce::facet(const Meeting& meeting, const RayQuery& query) const {
  const Splat& splat = splats_[meeting.index];
  const dvec3 dir = glm::normalize(dvec3(query.dir));
  const double radius = std::sqrt(splat.radius_squared);
  const dvec3 from_center = dvec3(query.origin) + meeting.t * dvec3(query.dir) - splat.center;
  const dvec3 lean = slopes_[meeting.index] * (from_center / radius);
  dvec3 normal = glm::normalize(splat.normal + lean + leans_[meeting.index]);
  if (meeting.cosine > 0.0) normal = -normal;
  if (const double away = glm::dot(normal, dir); away > 0.0) normal = glm::normalize(normal - away * dir);
  const double height = -0.5 * glm::dot(from_center, lean);
  const double cosine = glm::dot(splat.normal, dir);
  const double least = std::copysign(std::max(std::abs(cosine), 0.1), cosine);
  return {normal, meeting.t + height / least / glm::length(dvec3(query.dir))};
}

TrueHit BruteForce::nearest(const RayQuery& query, const Settings& settings) const {
  const std::vector<Meeting> met = meetings(query, settings);
  TrueHit hit;
  if (met.empty()) return hit;
  const Meeting& first = *std::min_element(met.begin(), met.end(), [&](const Meeting& a, const Meeting& b) {
    return a.t != b.t ? a.t < b.t : order_of(words_[a.index]) < order_of(words_[b.index]);
  });
  const Splat& first_splat = splats_[first.index];
  const double dir_length = glm::length(dvec3(query.dir));
  auto against = [&](const Meeting& m) {
    return m.cosine > 0.0 ? -splats_[m.index].normal : splats_[m.index].normal;
  };
  const double depth = double(settings.kappa) * std::sqrt(first_splat.radius_squared) /
                       std::max(std::abs(first.cosine) / dir_length, 0.1) / dir_length;
  hit.found = true;
  hit.t_first = first.t;
  hit.first = first.index;
  hit.object = first_splat.object;
  hit.front = first.cosine < 0.0;
  if (settings.blend == BLEND_COUNT) {
    hit.members = static_cast<std::uint32_t>(met.size());
    hit.t = first.t;
    return hit;
  }
  double weight_sum = 0.0;
  double depth_sum = 0.0;
  dvec3 normal_sum(0.0);
  dvec3 color_sum(0.0);
  for (const Meeting& m : met) {
    const double share = (m.t - first.t) / depth;
    const bool alone = settings.blend == BLEND_NEAREST;
    if (alone ? m.index != first.index : share > 1.0 || splats_[m.index].object != hit.object) continue;
    if ((m.cosine > 0.0) != (first.cosine > 0.0) || glm::dot(against(m), against(first)) <= 0.5) continue;
    const double weight = std::max(kernel_of(settings, m.u_squared) * fall_of(share), 1.0 / 256.0);
    const Facet surface = facet(m, query);
    weight_sum += weight;
    depth_sum += weight * (alone ? surface.t - first.t : std::clamp(surface.t - first.t, -depth, depth));
    normal_sum += weight * surface.normal;
    if (!colors_.empty()) color_sum += weight * dvec3(unpack_color(colors_[m.index]));
    ++hit.members;
  }
  hit.t = first.t + depth_sum / weight_sum;
  hit.normal = glm::normalize(normal_sum);
  if (!colors_.empty()) hit.color = color_sum / weight_sum;
  return hit;
}

}  // namespace splatray::testing
