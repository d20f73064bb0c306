#include "app/library/picture/aimed_ray.h"

#include <algorithm>
#include <limits>
#include <ranges>

#include "engine/scene/scene_splat.h"
#include "preprocess/base/morton.h"

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

std::optional<std::size_t> find_splat(const Scene& scene, const RayHit& hit) {
  // Splats lie in Z-order of their centres.
  const auto key = [](const SceneSplat& splat) { return morton_key(glm::uvec3(splat.in_root().center)); };
  const auto key_at = [&](std::size_t i) { return key(splat_at(scene, i)); };
  const std::uint64_t wanted = key({scene, hit.first});
  const std::size_t count = splat_count(scene);
  const auto indices = std::views::iota(std::size_t{0}, count);
  const auto first = std::ranges::lower_bound(indices, wanted, {}, key_at);
  auto i = static_cast<std::size_t>(first - indices.begin());
  while (i < count && key_at(i) == wanted && splat_at(scene, i).words() != hit.first) ++i;
  if (i == count || key_at(i) != wanted) return {};
  return i;
}

}  // namespace splatray
