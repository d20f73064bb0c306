#include "preprocess/leaf_slabs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "preprocess/disc.h"

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

/// Between which planes across the axis the splats of a leaf lie.
Interval extent(std::span<const Splat> splats, const glm::dvec3& axis, const glm::dvec3& center,
                double half_size) {
  Interval all{half_size, -half_size};
  for (const Splat& splat : splats) {
    // The two ends may be swapped: by rounding in a flat leaf, or for a disc that only touches the inflated cell.
    const Interval one = extent(splat, axis, center, half_size);
    const auto [low, high] = std::minmax(one.low, one.high);
    all = {std::min(all.low, low), std::max(all.high, high)};
  }
  return all;
}

enum Side : std::uint8_t { LOWER, BOTH, UPPER };

/// Which halves of a cell a disc may reach; lower where it reaches neither, as then no ray hits it in the cell.
Side side_of(const Splat& splat, const OctreeCell& cell, int axis) {
  const std::uint32_t half = cell.size / 2;
  const ChildTest test(Disc(splat), cell.low, half);
  bool reached[2] = {false, false};
  for (std::uint32_t child = 0; child < 8; ++child) {
    const std::uint32_t x = child & 1U, y = child >> 1 & 1U, z = child >> 2;
    if (test.may_meet(x, y, z)) reached[child >> axis & 1U] = true;
  }
  if (reached[0] && reached[1]) return BOTH;
  return reached[1] ? UPPER : LOWER;
}

/// The slab of one leaf; its list is put in the order of the halves.
std::uint32_t halve_leaf(std::span<std::uint32_t> list, std::span<const uvec4> data_pool,
                         const OctreeCell& cell) {
  std::vector<Splat> splats;
  splats.reserve(list.size());
  for (const std::uint32_t i : list) splats.push_back(unpack_splat(data_pool[i]));
  const auto listed = static_cast<std::uint32_t>(list.size());
  const glm::dvec3 axis =
      unpack_slab(pack_slab({mean_direction(splats), -1.0, 1.0, listed, 0}, listed), listed).axis;
  const double half_size = 0.5 * cell.size;
  const Interval all = extent(splats, axis, glm::dvec3(cell.low) + half_size, half_size);
  const int across = halved_axis(axis);
  std::vector<std::pair<Side, std::uint32_t>> sides;
  sides.reserve(list.size());
  for (std::size_t i = 0; i < list.size(); ++i) sides.emplace_back(side_of(splats[i], cell, across), list[i]);
  std::array<std::uint32_t, 3> count{};
  auto place = list.begin();
  for (const Side side : {LOWER, BOTH, UPPER}) {
    for (const auto& [its, splat] : sides) {
      if (its != side) continue;
      *place++ = splat;
      ++count[side];
    }
  }
  return pack_slab({axis, std::clamp(all.low / half_size, -1.0, 1.0),
                    std::clamp(all.high / half_size, -1.0, 1.0), count[LOWER] + count[BOTH], count[LOWER]},
                   listed);
}

}  // namespace

void add_slabs(Scene& scene, const Stage& stage) {
  const std::vector<OctreeCell> cells = leaf_cells(scene);
  scene.slab_pool.resize(cells.size());
  parallel_each(stage, cells.size(), [&](std::size_t leaf) {
    const std::uint32_t begin = scene.begin_end[leaf];
    const std::span list = std::span(scene.reference_pool).subspan(begin, scene.begin_end[leaf + 1] - begin);
    scene.slab_pool[leaf] = halve_leaf(list, scene.data_pool, cells[leaf]);
  });
}

}  // namespace splatray
