/// The root cube of the octree.
#pragma once
#include <glm/glm.hpp>

#include "engine/scene/scene.h"

namespace splatray {

/// Axis-aligned bounds of discs in world space. Discs are added one by one.
struct DiscBounds {
  glm::dvec3 low{1e300};
  glm::dvec3 high{-1e300};

  /// `normal` is a unit vector, `radius` is finite and >= 0.
  void add(const glm::dvec3& center, const glm::dvec3& normal, double radius);
  void add(const DiscBounds& other);
};

/// The cube around the discs: packed, they keep ROOT_MARGIN lattice units from its faces. They are in
/// its middle, but along axes on which they are thin, as flat sheets are, off it. The lattice unit is
/// not below 2^-45 of the largest coordinate, so that to_root stays exact to a small share of a unit. The
/// bounds must not be empty.
[[nodiscard]] RootTransform fit_root(const DiscBounds& bounds);

}  // namespace splatray
