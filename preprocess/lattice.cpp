#include "preprocess/lattice.h"

#include <algorithm>
#include <cmath>

#include "engine/base/release.h"
#include "engine/scene/splat.h"

namespace splatray {
namespace {

constexpr double OFF_LATTICE = 1e-3;  // lattice units that reading may have moved a point by
constexpr double MOST_UNITS = 1U << LATTICE_BITS;

/// Whether all three are between the bounds.
bool is_within(const glm::dvec3& v, double low, double high) {
  return glm::all(glm::greaterThanEqual(v, glm::dvec3(low))) &&
         glm::all(glm::lessThanEqual(v, glm::dvec3(high)));
}

/// Whether the point is on the lattice, and the disc that it becomes within the root.
bool is_kept(const Cloud& cloud, const RootTransform& root, std::size_t i) {
  const glm::dvec3 place = root.to_root(cloud.place_world(i));
  const double radius = cloud.radius[i] * cloud.half_extent_world / root.unit_world;
  if (cloud.normal[i] == glm::vec3(0.0F) || !(radius > 0.0 && radius < MOST_UNITS) ||
      !is_within(place, 0.0, MOST_UNITS - 1.0) ||
      !is_within(place - glm::round(place), -OFF_LATTICE, OFF_LATTICE))
    return false;
  const Splat splat =
      unpack_splat(pack_splat({place, glm::normalize(glm::dvec3(cloud.normal[i])), radius * radius, 0}));
  const glm::dvec3 half =
      std::sqrt(splat.radius_squared) * glm::sqrt(glm::max(1.0 - splat.normal * splat.normal, 0.0));
  return is_within(splat.center - half, ROOT_MARGIN, MOST_UNITS) &&
         is_within(splat.center + half, 0.0, MOST_UNITS - ROOT_MARGIN);
}

bool are_kept(const std::vector<Cloud>& clouds, const BuildParams& params) {
  if (clouds.size() != 1 || !clouds[0].lattice || params.ground || params.radius_scale != 1.0) return false;
  const Cloud& cloud = clouds[0];
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (cloud.radius.empty() || !is_kept(cloud, *cloud.lattice, i)) return false;
  return true;
}

}  // namespace

std::optional<RootTransform> kept_lattice(std::vector<Cloud>& clouds, const BuildParams& params) {
  if (are_kept(clouds, params)) return clouds[0].lattice;
  for (Cloud& cloud : clouds) cloud.lattice.reset(), release(cloud.field_words), release(cloud.clip_words);
  return {};
}

}  // namespace splatray
