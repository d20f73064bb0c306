#include "engine/image/region.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <numbers>
#include <string>

#include "engine/base/error.h"

namespace splatray {

bool Region::holds(const glm::dvec3& point) const {
  const auto inside = [&point](const HalfSpace& half) { return half.holds(point); };
  const bool is_dropped = !dropped.empty() && std::all_of(dropped.begin(), dropped.end(), inside);
  return std::all_of(kept.begin(), kept.end(), inside) && !is_dropped;
}

std::array<HalfSpace, REGION_BOX_PLANES> half_spaces(const TurnedBox& box, const glm::dvec3& up) {
  const glm::dvec3 middle = 0.5 * (box.low + box.high), half = 0.5 * (box.high - box.low);
  const glm::dquat turn = glm::angleAxis(box.turn_deg * std::numbers::pi / 180.0, glm::normalize(up));
  std::array<HalfSpace, REGION_BOX_PLANES> planes;
  for (glm::length_t axis = 0; axis < 3; ++axis) {
    glm::dvec3 unit(0.0);
    unit[axis] = 1.0;
    if (box.turn_deg != 0.0) unit = turn * unit;
    planes[2 * static_cast<std::size_t>(axis)] = {middle - half[axis] * unit, unit};
    planes[2 * static_cast<std::size_t>(axis) + 1] = {middle + half[axis] * unit, -unit};
  }
  return planes;
}

std::vector<vec4> region_planes(const RootTransform& root, const Region& region) {
  if (region.kept.size() > REGION_PLANES_MOST)
    throw Error(ExitCode::usage, "the region has " + std::to_string(region.kept.size()) +
                                     " planes to keep a side of, expected at most " +
                                     std::to_string(REGION_PLANES_MOST) + ", of which a box takes six");
  if (region.dropped.size() > REGION_BOX_PLANES)
    throw Error(ExitCode::usage, "the region drops more than a box");
  std::vector<vec4> planes;
  for (const std::vector<HalfSpace>& halves : {region.kept, region.dropped})
    for (const HalfSpace& half : halves) {
      const glm::dvec3 normal = glm::normalize(half.normal);
      const double w = glm::dot(normal, root.to_root(half.point));
      if (!std::isfinite(w))
        throw Error(ExitCode::usage, "a plane of the region is not finite or has no direction");
      planes.emplace_back(normal, w);
    }
  return planes;
}

void set_region(const RootTransform& root, const Region& region, FrameParams& frame) {
  const std::vector<vec4> planes = region_planes(root, region);
  std::copy(planes.begin(), planes.end(), frame.region);
  frame.region_kept = static_cast<std::uint32_t>(region.kept.size());
  frame.region_dropped = static_cast<std::uint32_t>(region.dropped.size());
  frame.region_light = region.cuts_light ? 1 : 0;
}

}  // namespace splatray
