#include "app/library/picture/aimed_ray.h"

#include <algorithm>
#include <limits>

namespace splatray {

std::optional<AimedRay> aim_ray(const RootTransform& root, const glm::dvec3& origin_world,
                                const glm::dvec3& dir) {
  constexpr double ROOT_EDGE = 1U << LATTICE_BITS;
  const glm::dvec3 from = root.to_root(origin_world);
  double enter = 0.0, leave = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    if (dir[axis] == 0.0) {
      if (!(from[axis] >= 0.0 && from[axis] <= ROOT_EDGE)) return {};
      continue;
    }
    const double a = -from[axis] / dir[axis], b = (ROOT_EDGE - from[axis]) / dir[axis];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  if (!(enter < leave)) return {};
  AimedRay aimed;
  aimed.query.origin = glm::clamp(from + enter * dir, 0.0, ROOT_EDGE);
  aimed.query.dir = dir;
  aimed.query.from_object = NO_OBJECT;
  aimed.start = enter;
  return aimed;
}

}  // namespace splatray
