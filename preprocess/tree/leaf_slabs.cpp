#include "preprocess/tree/leaf_slabs.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "preprocess/base/vector_clones.h"
#include "preprocess/tree/disc.h"

namespace splatray {
namespace {

/// Which halves of its cell a disc reaches; lower where it reaches neither, as then no ray hits it in the cell.
enum Side : std::uint8_t { LOWER, BOTH, UPPER };

constexpr std::size_t LANES = 8;

/// So many splats, one array for each number, for loops that take several splats at once.
struct SplatBlock {
  double x[LANES], y[LANES], z[LANES];
  double normal_x[LANES], normal_y[LANES], normal_z[LANES];
  double radius_squared[LANES];
};

/// Where they lie in a cell.
struct BlockReach {
  double low[LANES], high[LANES];                   ///< along the slab's axis, from the cell's centre
  double beyond_lower[LANES], beyond_upper[LANES];  ///< above 0 where they do not come near the half
};

/// A cell's halves and the axis of its slab.
struct HalvedCell {
  HalvedCell(const OctreeCell& cell, const glm::dvec3& slab_axis)
      : axis(slab_axis),
        half_size(0.5 * cell.size),
        low(cell.low),
        high(low + 2.0 * half_size),
        lower_high(high),
        upper_low(low) {
    const int across = halved_axis(axis);
    lower_high[across] = upper_low[across] = low[across] + half_size;
  }
  glm::dvec3 axis;
  double half_size;
  glm::dvec3 low, high;
  glm::dvec3 lower_high;  ///< upper corner of the lower half
  glm::dvec3 upper_low;
};

SPLATRAY_VECTOR_CLONES void unpack_blocks(std::span<const std::uint32_t> list,
                                          std::span<const uvec4> data_pool, std::vector<SplatBlock>& blocks) {
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    uvec4 words[LANES];
    for (std::size_t i = 0; i < LANES; ++i)
      words[i] = data_pool[list[std::min(b * LANES + i, list.size() - 1)]];
    SplatBlock block;
    for (std::size_t i = 0; i < LANES; ++i) {
      const Splat splat = unpack_splat(words[i]);
      block.x[i] = splat.center.x;
      block.y[i] = splat.center.y;
      block.z[i] = splat.center.z;
      block.normal_x[i] = splat.normal.x;
      block.normal_y[i] = splat.normal.y;
      block.normal_z[i] = splat.normal.z;
      block.radius_squared[i] = splat.radius_squared;
    }
    blocks[b] = block;
  }
}

/// From where to where something reaches along the slab's axis, from the cell's centre.
struct Reach {
  double low, high;
};

/// What bounds where the plane n.p = distance reaches in the cube |x|, |y|, |z| <= half_size along the axis a: for any factor,
/// a = factor n + rest, and a.p differs from factor times the distance by what the cube reaches along the rest. Where the
/// bound is tightest one component of the rest is 0 (the dual of the linear program, which has a kink there).
[[gnu::always_inline]] inline Reach plane_in_cube(double factor, const Disc& disc, const glm::dvec3& axis,
                                                  double distance, double half_size) {
  const double rest = std::abs(axis.x - factor * disc.x.normal) + std::abs(axis.y - factor * disc.y.normal) +
                      std::abs(axis.z - factor * disc.z.normal);
  return {factor * distance - half_size * rest, factor * distance + half_size * rest};
}

/// Between what the part of a disc in the inflated cell lies: the disc's own ends, or those of its plane in the cell.
[[gnu::always_inline]] inline Reach reach_in_cell(const Disc& disc, const HalvedCell& cell) {
  const glm::dvec3& axis = cell.axis;
  const double x = disc.x.center - cell.low.x - cell.half_size;
  const double y = disc.y.center - cell.low.y - cell.half_size;
  const double z = disc.z.center - cell.low.z - cell.half_size;
  const double distance = disc.x.normal * x + disc.y.normal * y + disc.z.normal * z;
  const double half_size = cell.half_size + LIST_INFLATION;
  // Not a number where the axis and the normal have no such component; std::max and min then keep the other.
  const Reach at_x = plane_in_cube(axis.x / disc.x.normal, disc, axis, distance, half_size);
  const Reach at_y = plane_in_cube(axis.y / disc.y.normal, disc, axis, distance, half_size);
  const Reach at_z = plane_in_cube(axis.z / disc.z.normal, disc, axis, distance, half_size);
  const double along_normal = axis.x * disc.x.normal + axis.y * disc.y.normal + axis.z * disc.z.normal;
  const double middle = axis.x * x + axis.y * y + axis.z * z;
  const double across =
      disc.radius * std::sqrt(std::max(glm::dot(axis, axis) - along_normal * along_normal, 0.0));
  const double low = std::max(std::max(std::max(middle - across, at_x.low), at_y.low), at_z.low);
  const double high = std::min(std::min(std::min(middle + across, at_x.high), at_y.high), at_z.high);
  // Swapped by rounding in a flat leaf, or for a disc that only touches the inflated cell.
  return {std::min(low, high), std::max(low, high)};
}

SPLATRAY_VECTOR_CLONES void measure_blocks(const std::vector<SplatBlock>& blocks, const HalvedCell& cell,
                                           std::vector<BlockReach>& reaches) {
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const SplatBlock& block = blocks[b];
    BlockReach reach;
    for (std::size_t i = 0; i < LANES; ++i) {
      const Disc disc({block.x[i], block.y[i], block.z[i]},
                      {block.normal_x[i], block.normal_y[i], block.normal_z[i]}, block.radius_squared[i]);
      const Reach along = reach_in_cell(disc, cell);
      reach.low[i] = along.low;
      reach.high[i] = along.high;
      reach.beyond_lower[i] = beyond(disc, cell.low, cell.lower_high);
      reach.beyond_upper[i] = beyond(disc, cell.upper_low, cell.high);
    }
    reaches[b] = reach;
  }
}

/// Sum of the normals, each turned to the side of the first; some axis where they cancel out.
glm::dvec3 mean_direction(const std::vector<SplatBlock>& blocks, std::size_t count) {
  const auto normal = [&](std::size_t i) {
    const SplatBlock& block = blocks[i / LANES];
    return glm::dvec3(block.normal_x[i % LANES], block.normal_y[i % LANES], block.normal_z[i % LANES]);
  };
  const glm::dvec3 first = normal(0);
  glm::dvec3 sum(0.0);
  for (std::size_t i = 0; i < count; ++i) sum += glm::dot(normal(i), first) < 0.0 ? -normal(i) : normal(i);
  return glm::dot(sum, sum) > 0.0 ? sum : first;
}

/// What the leaves of a thread use one after the other.
struct Workspace {
  std::vector<SplatBlock> blocks;
  std::vector<BlockReach> reaches;
  std::vector<std::uint32_t> list;
};

/// The slab of one leaf; its list is put in the order of the halves.
std::uint32_t halve_leaf(std::span<std::uint32_t> list, std::span<const uvec4> data_pool,
                         const OctreeCell& cell, Workspace& space) {
  space.blocks.resize((list.size() + LANES - 1) / LANES);
  space.reaches.resize(space.blocks.size());
  unpack_blocks(list, data_pool, space.blocks);
  const auto listed = static_cast<std::uint32_t>(list.size());
  const HalvedCell halved(cell, nearest_slab_axis(mean_direction(space.blocks, list.size())));
  measure_blocks(space.blocks, halved, space.reaches);
  double low = halved.half_size, high = -halved.half_size;
  std::array<std::uint32_t, 3> count{};
  space.list.assign(list.begin(), list.end());
  auto place = list.begin();
  for (const Side side : {LOWER, BOTH, UPPER}) {
    for (std::size_t i = 0; i < space.list.size(); ++i) {
      const BlockReach& reach = space.reaches[i / LANES];
      const std::size_t lane = i % LANES;
      const Side its =
          reach.beyond_upper[lane] > 0.0 ? LOWER : (reach.beyond_lower[lane] > 0.0 ? UPPER : BOTH);
      if (its != side) continue;
      low = std::min(low, reach.low[lane]);
      high = std::max(high, reach.high[lane]);
      *place++ = space.list[i];
      ++count[side];
    }
  }
  return pack_slab({halved.axis, std::clamp(low / halved.half_size, -1.0, 1.0),
                    std::clamp(high / halved.half_size, -1.0, 1.0), count[LOWER] + count[BOTH], count[LOWER]},
                   listed);
}

}  // namespace

void add_slabs(Scene& scene, const Stage& stage) {
  const std::vector<OctreeCell> cells = leaf_cells(scene);
  scene.slab_pool.resize(cells.size());
  tbb::enumerable_thread_specific<Workspace> spaces;
  parallel_each(stage, cells.size(), [&](std::size_t leaf) {
    const std::uint32_t begin = scene.begin_end[leaf];
    const std::span list = std::span(scene.reference_pool).subspan(begin, scene.begin_end[leaf + 1] - begin);
    scene.slab_pool[leaf] = halve_leaf(list, scene.data_pool, cells[leaf], spaces.local());
  });
}

}  // namespace splatray
