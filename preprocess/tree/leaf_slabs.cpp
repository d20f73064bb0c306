#include "preprocess/tree/leaf_slabs.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "engine/base/vector_clones.h"
#include "engine/scene/leaf/halved_cell.h"
#include "engine/scene/leaf/slab.h"
#include "engine/scene/splat.h"
#include "engine/scene/tree.h"

namespace splatray {
namespace {

/// Which halves of its cell a disc reaches; lower where it reaches neither, as then no ray hits it in the cell.
enum CellSide : std::uint8_t { LOWER, BOTH, UPPER };

constexpr std::size_t SPLATS_AT_ONCE = 8;

/// SPLATS_AT_ONCE splats, one array for each number, for loops that take several splats at once.
struct SplatBlock {
  double x[SPLATS_AT_ONCE], y[SPLATS_AT_ONCE], z[SPLATS_AT_ONCE];
  double normal_x[SPLATS_AT_ONCE], normal_y[SPLATS_AT_ONCE], normal_z[SPLATS_AT_ONCE];
  double radius_squared[SPLATS_AT_ONCE];
};

/// Where they lie in a cell.
struct BlockReach {
  double low[SPLATS_AT_ONCE], high[SPLATS_AT_ONCE];  ///< along the slab's axis, from the cell's centre
  /// Above 0 where they do not come near the half.
  double beyond_lower[SPLATS_AT_ONCE], beyond_upper[SPLATS_AT_ONCE];
};

SPLATRAY_VECTOR_CLONES void unpack_blocks(std::span<const std::uint32_t> list,
                                          std::span<const uvec4> data_pool, std::vector<SplatBlock>& blocks) {
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    uvec4 words[SPLATS_AT_ONCE];
    for (std::size_t i = 0; i < SPLATS_AT_ONCE; ++i)
      words[i] = data_pool[list[std::min(b * SPLATS_AT_ONCE + i, list.size() - 1)]];
    SplatBlock block;
    for (std::size_t i = 0; i < SPLATS_AT_ONCE; ++i) {
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

SPLATRAY_VECTOR_CLONES void measure_blocks(const std::vector<SplatBlock>& blocks, const HalvedCell& cell,
                                           std::vector<BlockReach>& reaches) {
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const SplatBlock& block = blocks[b];
    BlockReach reach;
    for (std::size_t i = 0; i < SPLATS_AT_ONCE; ++i) {
      const Disc disc({block.x[i], block.y[i], block.z[i]},
                      {block.normal_x[i], block.normal_y[i], block.normal_z[i]}, block.radius_squared[i]);
      const Reach along = reach_in_cell(disc, cell, LIST_INFLATION);
      // Swapped by rounding in a flat leaf, or for a disc that only touches the inflated cell.
      reach.low[i] = std::min(along.low, along.high);
      reach.high[i] = std::max(along.low, along.high);
      reach.beyond_lower[i] = beyond(disc, cell.low, cell.lower_high);
      reach.beyond_upper[i] = beyond(disc, cell.upper_low, cell.high);
    }
    reaches[b] = reach;
  }
}

/// Sum of the normals, each turned to the side of the first; some axis where they cancel out.
glm::dvec3 mean_direction(const std::vector<SplatBlock>& blocks, std::size_t count) {
  const auto normal = [&](std::size_t i) {
    const SplatBlock& block = blocks[i / SPLATS_AT_ONCE];
    return glm::dvec3(block.normal_x[i % SPLATS_AT_ONCE], block.normal_y[i % SPLATS_AT_ONCE],
                      block.normal_z[i % SPLATS_AT_ONCE]);
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
  std::vector<CellSide> sides;
};

/// The slab of one leaf; its list is put in the order of the halves.
std::uint32_t halve_leaf(std::span<std::uint32_t> list, std::span<const uvec4> data_pool,
                         const OctreeCell& cell, Workspace& space) {
  space.blocks.resize((list.size() + SPLATS_AT_ONCE - 1) / SPLATS_AT_ONCE);
  space.reaches.resize(space.blocks.size());
  unpack_blocks(list, data_pool, space.blocks);
  const auto listed = static_cast<std::uint32_t>(list.size());
  const HalvedCell halved(cell, nearest_slab_axis(mean_direction(space.blocks, list.size())));
  measure_blocks(space.blocks, halved, space.reaches);
  double low = halved.half_size, high = -halved.half_size;
  std::array<std::uint32_t, 3> count{};
  space.list.assign(list.begin(), list.end());
  space.sides.resize(list.size());
  for (std::size_t i = 0; i < list.size(); ++i) {
    const BlockReach& reach = space.reaches[i / SPLATS_AT_ONCE];
    const std::size_t lane = i % SPLATS_AT_ONCE;
    const CellSide side =
        reach.beyond_upper[lane] > 0.0 ? LOWER : (reach.beyond_lower[lane] > 0.0 ? UPPER : BOTH);
    low = std::min(low, reach.low[lane]);
    high = std::max(high, reach.high[lane]);
    space.sides[i] = side;
    ++count[side];
  }
  std::array<std::uint32_t, 3> place{0, count[LOWER], count[LOWER] + count[BOTH]};
  for (std::size_t i = 0; i < list.size(); ++i) list[place[space.sides[i]]++] = space.list[i];
  return pack_slab({halved.axis, std::clamp(low / halved.half_size, -1.0, 1.0),
                    std::clamp(high / halved.half_size, -1.0, 1.0), count[LOWER] + count[BOTH], count[LOWER]},
                   listed);
}

}  // namespace

void add_slabs(Scene& scene, const Stage& stage) {
  const std::vector<OctreeCell> cells = leaf_cells(scene);
  std::vector<std::uint32_t> slabs(cells.size());
  const std::span references(scene.reference_pool.edit());
  tbb::enumerable_thread_specific<Workspace> spaces;
  parallel_each(stage, cells.size(), [&](std::size_t leaf) {
    const std::uint32_t begin = scene.begin_end[leaf];
    const std::span list = references.subspan(begin, scene.begin_end[leaf + 1] - begin);
    slabs[leaf] = halve_leaf(list, scene.data_pool, cells[leaf], spaces.local());
  });
  scene.slab_pool = std::move(slabs);
}

}  // namespace splatray
