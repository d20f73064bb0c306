#include "tests/bench/exact/exact_rays.h"

#include <cassert>
#include <cmath>

#include "engine/scene/splat.h"

namespace splatray::testing {
namespace {

using glm::dvec3;

constexpr double EDGE = 1U << LATTICE_BITS;

RayQuery query_of(const dvec3& origin, const dvec3& dir) {
  RayQuery query{};
  query.origin = vec3(origin);
  query.dir = vec3(glm::normalize(dir));
  query.from_object = NO_OBJECT;
  return query;
}

/// Direction and mask of a ray that a dielectric lets through, or reflects where it cannot.
struct Refracted {
  dvec3 dir;
  std::uint32_t inside;
};

Refracted refract_at(const TrueHit& hit, const Material& material, const dvec3& dir, std::uint32_t inside) {
  const double cosine = -glm::dot(dir, hit.normal);
  const double eta = hit.front ? 1.0 / double(material.ior) : double(material.ior);
  const double left = 1.0 - eta * eta * (1.0 - cosine * cosine);
  if (left <= 0.0) return {dir + 2.0 * cosine * hit.normal, inside};
  return {eta * dir + (eta * cosine - std::sqrt(left)) * hit.normal, inside ^ (1U << material.mask_bit)};
}

dvec3 in_plane(const Splat& splat, Dice& dice) {
  return glm::normalize(glm::cross(splat.normal, dice.direction()));
}

/// On lattice planes, edges and corners of cells of any size.
dvec3 lattice_point(Dice& dice) {
  const double step = std::exp2(double(dice.below(LATTICE_BITS)));
  return glm::round(EDGE * (dvec3(0.5) + 0.75 * dice.in_cube()) / step) * step;
}

RayQuery along_lattice(const Splat& splat, Dice& dice) {
  const double step = std::exp2(double(dice.below(LATTICE_BITS)));
  dvec3 dir = dice.axis();
  if (dice.chance(0.4)) dir += dice.axis();
  if (dice.chance(0.2)) dir += dice.axis();
  if (glm::dot(dir, dir) < 0.5) dir = dice.axis();
  const dvec3 through = dice.chance(0.5) ? splat.center : glm::round(splat.center / step) * step;
  RayQuery query = query_of(through - std::floor(dice.between(0.0, 3.0)) * EDGE / 2.0 * dir, dir);
  for (int axis = 0; axis < 3; ++axis)
    if (query.dir[axis] == 0.0F) query.dir[axis] = dice.chance(0.5) ? 0.0F : -0.0F;
  return query;
}

RayQuery corner_to_corner(Dice& dice) {
  const dvec3 from = lattice_point(dice);
  dvec3 dir = lattice_point(dice) - from;
  if (dir == dvec3(0.0)) dir = dice.axis();
  return query_of(from, dir);
}

RayQuery with_tiny_components(const Splat& splat, Dice& dice) {
  dvec3 dir = dice.axis();
  for (int axis = 0; axis < 3; ++axis)
    if (dir[axis] == 0.0 && dice.chance(0.7)) dir[axis] = dice.sign() * dice.log_between(1e-45, 1e-7);
  const dvec3 target =
      splat.center + 0.9 * std::sqrt(splat.radius_squared) * dice.unit() * in_plane(splat, dice);
  return query_of(target - EDGE * dice.between(-0.5, 2.0) * dir, dir);
}

RayQuery at_rim(const Splat& splat, Dice& dice) {
  constexpr std::array BESIDE{0.0, 1e-9, -1e-9, 1e-6, -1e-6, 1e-3, -1e-3};
  const double reach = std::sqrt(splat.radius_squared) * (1.0 + BESIDE[dice.below(BESIDE.size())]);
  const dvec3 dir = dice.direction();
  return query_of(splat.center + reach * in_plane(splat, dice) - dice.log_between(1.0, EDGE) * dir, dir);
}

RayQuery adversarial_ray(std::string_view kind, const Splat& splat, Dice& dice) {
  if (kind == "along the lattice") return along_lattice(splat, dice);
  if (kind == "corner to corner") return corner_to_corner(dice);
  if (kind == "tiny components") return with_tiny_components(splat, dice);
  if (kind == "from splats") return query_of(splat.center, dice.direction());
  if (kind == "from splats, in plane") return query_of(splat.center, in_plane(splat, dice));
  if (kind == "at rims") return at_rim(splat, dice);
  const dvec3 target = splat.center + std::sqrt(splat.radius_squared * dice.unit()) * in_plane(splat, dice);
  if (kind == "from afar") {
    const dvec3 dir = dice.direction();
    return query_of(target - EDGE * dice.between(2.0, 7.0) * dir, dir);
  }
  assert(kind == "nearly in a disc's plane");
  const dvec3 dir = in_plane(splat, dice) + dice.sign() * dice.log_between(1e-9, 0.1) * splat.normal;
  return query_of(target - EDGE * dice.unit() * glm::normalize(dir), dir);
}

}  // namespace

std::vector<RayQuery> following_rays(const Scene& scene, const std::vector<RayQuery>& rays,
                                     const std::vector<TrueHit>& hits, Next next, const dvec3& to_light) {
  std::vector<RayQuery> following;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const TrueHit& hit = hits[i];
    if (!hit.found) continue;
    const dvec3 dir(rays[i].dir);
    Refracted out{to_light, rays[i].inside};
    if (next == Next::shadow && glm::dot(hit.normal, to_light) <= 0.0) continue;
    if (next == Next::mirrored) out.dir = dir - 2.0 * glm::dot(dir, hit.normal) * hit.normal;
    if (next == Next::refracted) out = refract_at(hit, scene.materials[hit.object], dir, rays[i].inside);
    RayQuery query = query_of(dvec3(rays[i].origin) + hit.t * dir, out.dir);
    query.inside = out.inside;
    query.from_normal = vec3(hit.front ? hit.normal : -hit.normal);
    query.from_object = hit.object;
    following.push_back(query);
  }
  return following;
}

Region random_region(const Scene& scene, Dice& dice) {
  const dvec3 middle = 0.5 * (scene.bounds_min_world + scene.bounds_max_world);
  const dvec3 size = scene.bounds_max_world - scene.bounds_min_world;
  const auto box = [&] {
    const dvec3 center = middle + 0.2 * size * dice.in_cube();
    const dvec3 half = size * dvec3(dice.between(0.1, 0.4), dice.between(0.1, 0.4), dice.between(0.1, 0.4));
    const auto planes = half_spaces({center - half, center + half, dice.between(0.0, 90.0)}, scene.up);
    return std::vector<HalfSpace>(planes.begin(), planes.end());
  };
  Region region;
  if (dice.chance(0.3)) {
    region.kept = box();
    return region;
  }
  for (std::uint64_t planes = 1 + dice.below(3); planes > 0; --planes)
    region.kept.push_back(
        {middle + 0.2 * size * dice.in_cube(), dice.chance(0.3) ? dice.axis() : dice.direction()});
  if (dice.chance(0.5)) region.dropped = box();
  return region;
}

std::vector<RayQuery> rays_from_anywhere(std::size_t count, Dice& dice) {
  std::vector<RayQuery> rays;
  while (rays.size() < count) rays.push_back(query_of(EDGE * (0.5 + dice.in_cube()), dice.direction()));
  return rays;
}

std::vector<RayQuery> adversarial_rays(std::string_view kind, const BruteForce& brute, std::size_t count,
                                       Dice& dice) {
  std::vector<RayQuery> rays;
  while (rays.size() < count)
    rays.push_back(adversarial_ray(
        kind, brute.splats()[dice.below(static_cast<std::uint32_t>(brute.splats().size()))], dice));
  return rays;
}

}  // namespace splatray::testing
