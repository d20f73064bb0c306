#include "preprocess/leaf_slabs.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace splatray {
namespace {

/// Sum of the normals, each turned to the side of the first; some axis where they cancel out.
glm::dvec3 mean_direction(std::span<const Splat> splats) {
  const glm::dvec3& first = splats.front().normal;
  glm::dvec3 sum(0.0);
  for (const Splat& splat : splats) sum += glm::dot(splat.normal, first) < 0.0 ? -splat.normal : splat.normal;
  return glm::dot(sum, sum) > 0.0 ? sum : first;
}

struct Interval {
  double low, high;
};

/// Where along the axis, from the cell's centre, the part of a disc inside the ball around the inflated cell lies.
Interval extent(const Splat& splat, const glm::dvec3& axis, const glm::dvec3& center, double half_size) {
  const glm::dvec3 offset = splat.center - center;
  const double ball_radius = std::sqrt(3.0) * (half_size + LIST_INFLATION);
  const double plane_distance = glm::dot(splat.normal, offset);
  const double cut_squared = std::max(ball_radius * ball_radius - plane_distance * plane_distance, 0.0);
  const double along_normal = glm::dot(axis, splat.normal);
  const double across = std::sqrt(std::max(glm::dot(axis, axis) - along_normal * along_normal, 0.0));
  const double disc_middle = glm::dot(axis, offset), disc_reach = across * std::sqrt(splat.radius_squared);
  const double ball_middle = along_normal * plane_distance, ball_reach = across * std::sqrt(cut_squared);
  return {std::max(disc_middle - disc_reach, ball_middle - ball_reach),
          std::min(disc_middle + disc_reach, ball_middle + ball_reach)};
}

std::uint32_t slab_of(std::span<const Splat> splats, const OctreeCell& cell) {
  const glm::dvec3 axis = unpack_slab(pack_slab({mean_direction(splats), -1.0, 1.0})).axis;
  const double half_size = 0.5 * cell.size;
  const glm::dvec3 center = glm::dvec3(cell.low) + half_size;
  Interval all{half_size, -half_size};
  for (const Splat& splat : splats) {
    // The two ends may be swapped: by rounding in a flat leaf, or for a disc that only touches the inflated cell.
    const Interval one = extent(splat, axis, center, half_size);
    const auto [low, high] = std::minmax(one.low, one.high);
    all = {std::min(all.low, low), std::max(all.high, high)};
  }
  return pack_slab(
      {axis, std::clamp(all.low / half_size, -1.0, 1.0), std::clamp(all.high / half_size, -1.0, 1.0)});
}

}  // namespace

std::vector<std::uint32_t> leaf_slabs(const Scene& scene, const Stage& stage) {
  const std::vector<OctreeCell> cells = leaf_cells(scene);
  std::vector<std::uint32_t> slabs(cells.size());
  parallel_each(stage, cells.size(), [&](std::size_t leaf) {
    std::vector<Splat> splats(scene.begin_end[leaf + 1] - scene.begin_end[leaf]);
    for (std::size_t i = 0; i < splats.size(); ++i)
      splats[i] = unpack_splat(scene.data_pool[scene.reference_pool[scene.begin_end[leaf] + i]]);
    slabs[leaf] = slab_of(splats, cells[leaf]);
  });
  return slabs;
}

}  // namespace splatray
