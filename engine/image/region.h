/// What of a scene is shown: a convex body of half-spaces, without a box. Rays end at its planes exactly; splats stay whole.
#pragma once
#include <array>
#include <span>
#include <vector>

#include "engine/scene/scene.h"

namespace splatray {

/// The side of a plane that `normal` points to, world space.
struct HalfSpace {
  glm::dvec3 point{0.0};             ///< on the plane
  glm::dvec3 normal{0.0, 0.0, 1.0};  ///< any length > 0

  [[nodiscard]] bool holds(const glm::dvec3& place) const { return glm::dot(place - point, normal) >= 0.0; }
  bool operator==(const HalfSpace&) const = default;
};

struct Region {
  std::vector<HalfSpace> kept;     ///< what is in all of them is there; at most REGION_PLANES_MOST
  std::vector<HalfSpace> dropped;  ///< what is in all of them is not; none, or at most REGION_BOX_PLANES
  bool cuts_light = false;         ///< secondary rays, too, meet only what is there

  [[nodiscard]] bool empty() const { return kept.empty() && dropped.empty(); }
  /// Whether a point is in the region, world space.
  [[nodiscard]] bool holds(const glm::dvec3& point) const;
  bool operator==(const Region&) const = default;
};

/// A box of which four sides may be turned.
struct TurnedBox {
  glm::dvec3 low{0.0}, high{0.0};  ///< corners before it is turned, world space; low < high
  double turn_deg = 0.0;  ///< about the up direction through its middle, counter-clockwise seen from above

  bool operator==(const TurnedBox&) const = default;
};

/// The half-spaces that make a box. `up`: any length > 0.
[[nodiscard]] std::array<HalfSpace, REGION_BOX_PLANES> half_spaces(const TurnedBox& box,
                                                                   const glm::dvec3& up);

/// The planes in root space, as rays meet them: n.x >= w, n a unit vector, those kept first. Throws Error (usage) where there are
/// more of them than a region may have, or one is not finite or has no direction.
[[nodiscard]] std::vector<vec4> region_planes(const RootTransform& root, const Region& region);

/// Gives a frame the region.
void set_region(const RootTransform& root, const Region& region, FrameParams& frame);

}  // namespace splatray
