#include "tests/property/random_rays.h"

#include <array>
#include <cmath>
#include <limits>

#include "engine/scene/splat.h"
#include "tests/trace/rays.h"

namespace splatray::testing {
namespace {

using glm::dvec3;

constexpr double EDGE = 1U << LATTICE_BITS;

/// A ray before it is rounded.
struct ExactRay {
  dvec3 origin, dir;
};

dvec3 in_plane(const Splat& splat, Dice& dice) {
  return glm::normalize(glm::cross(splat.normal, dice.direction()));
}

/// A point to aim at: the splat's centre, on its disc, or on its rim but for nothing or a little.
dvec3 target_on(const Splat& splat, Dice& dice) {
  constexpr std::array BESIDE{0.0, 1e-9, -1e-9, 1e-6, -1e-6, 1e-3, -1e-3};
  const double radius = std::sqrt(splat.radius_squared);
  const dvec3 aside = in_plane(splat, dice);
  switch (dice.below(3)) {
    case 0:
      return splat.center;
    case 1:
      return splat.center + radius * std::sqrt(dice.unit()) * aside;
    default:
      return splat.center + radius * (1.0 + BESIDE[dice.below(BESIDE.size())]) * aside;
  }
}

ExactRay towards(dvec3 target, dvec3 dir, double distance) { return {target - distance * dir, dir}; }

/// Along an axis, a diagonal of a face or of the cube, through lattice points of any coarseness.
ExactRay along_lattice(const Splat& splat, Dice& dice) {
  const double step = std::exp2(double(dice.below(LATTICE_BITS)));
  dvec3 dir = dice.axis();
  if (dice.chance(0.5)) dir += dice.axis();
  if (dice.chance(0.3)) dir += dice.axis();
  if (glm::dot(dir, dir) < 0.5) dir = dice.axis();
  for (int axis = 0; axis < 3; ++axis)
    if (dir[axis] == 0.0) dir[axis] = dice.chance(0.5) ? 0.0 : -0.0;
  const dvec3 through = dice.chance(0.5) ? splat.center : glm::round(splat.center / step) * step;
  return {through - std::floor(dice.between(0.0, 3.0)) * EDGE / 2.0 * dir, dir};
}

/// From on a disc, up, down or along it.
ExactRay from_on(const Splat& splat, Dice& dice) {
  const dvec3 dir = dice.chance(0.5) ? dice.direction() : in_plane(splat, dice);
  return {target_on(splat, dice), dir};
}

ExactRay with_tiny_components(const Splat& splat, Dice& dice) {
  constexpr std::array TINY{1e-45, 1e-39, 1e-30, 1.1e-20, 0.9e-20, 1e-12, 1e-7};
  dvec3 dir = dice.axis();
  for (int axis = 0; axis < 3; ++axis)
    if (dir[axis] == 0.0 && dice.chance(0.7)) dir[axis] = dice.sign() * TINY[dice.below(TINY.size())];
  return towards(target_on(splat, dice), dir, EDGE * dice.between(-0.5, 2.0));
}

ExactRay exact_ray(const Splat& splat, Dice& dice) {
  switch (dice.below(6)) {
    case 0:
      return along_lattice(splat, dice);
    case 1:
      return from_on(splat, dice);
    case 2:
      return with_tiny_components(splat, dice);
    case 3:
      return towards(target_on(splat, dice), dice.direction(), FARTHEST_ORIGIN * dice.between(0.3, 0.9));
    case 4: {  // nearly in the disc's plane
      const dvec3 dir = in_plane(splat, dice) + dice.sign() * dice.log_between(1e-9, 0.1) * splat.normal;
      return towards(target_on(splat, dice), glm::normalize(dir), EDGE * dice.unit());
    }
    default:
      return towards(target_on(splat, dice), dice.direction(), dice.log_between(1.0, 3.0 * EDGE));
  }
}

float random_start(Dice& dice) {
  if (dice.chance(0.8)) return 0.0F;
  if (dice.chance(0.3)) return -std::numeric_limits<float>::infinity();
  return float(dice.sign() * dice.log_between(1e-3, EDGE));
}

}  // namespace

std::vector<RayQuery> random_rays(const Scene& scene, const BruteForce& brute, std::size_t count,
                                  Dice& dice) {
  std::vector<RayQuery> rays = random_primary_rays(scene, count / 8, dice.seed());
  while (rays.size() < count) {
    const Splat& splat = brute.splats()[dice.below(std::uint32_t(brute.splats().size()))];
    const ExactRay exact = exact_ray(splat, dice);
    RayQuery query{};
    query.origin = vec3(exact.origin);
    query.dir = vec3(glm::normalize(exact.dir));
    query.t_min = random_start(dice);
    query.from_object = NO_OBJECT;
    query.inside = dice.chance(0.5) ? 0U : dice.below(32);
    rays.push_back(query);
  }
  return rays;
}

}  // namespace splatray::testing
