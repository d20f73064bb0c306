/// The curves in which a plane cuts a scene's surface.
#pragma once
#include <vector>

#include "engine/image/region.h"
#include "engine/scene/scene.h"

namespace splatray {

/// A plane of the world and its coordinates: unit vectors to the right, to the top and, their cross product, towards the eye.
struct CutPlane {
  glm::dvec3 right{1.0, 0.0, 0.0}, top{0.0, 1.0, 0.0}, toward{0.0, 0.0, 1.0};
  double near = 0.0;  ///< where it is along `toward`, world units

  /// The world's place of a place on it.
  [[nodiscard]] glm::dvec3 world(const glm::dvec2& place) const {
    return place.x * right + place.y * top + near * toward;
  }
};

/// Places along CutPlane::right and top, world units; the surface's front lies to the left of most of the way.
struct CutCurve {
  std::vector<glm::dvec2> points;
  bool closed = false;  ///< the last point goes on to the first
  double radius = 0.0;  ///< of the largest splats that it follows from; 0 = of none
};

/// The curves, joined where they meet at corners and straight to the tolerance (world units, > 0) where they are nearly. Of what lies
/// nearly in the plane, and of fewer splats than make a surface, there are none. The scene has its pools.
[[nodiscard]] std::vector<CutCurve> plane_cut(const Scene& scene, const Region& region, const CutPlane& plane,
                                              double tolerance);

}  // namespace splatray
