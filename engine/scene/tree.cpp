#include "engine/scene/tree.h"

#include <algorithm>
#include <bit>

namespace splatray {

OctreeBox empty_box(std::uint32_t word, const OctreeCell& cell) {
  const auto steps = [word](int first_bit) {
    return glm::ivec3(word >> first_bit & 3U, word >> (first_bit + 4) & 3U, word >> (first_bit + 8) & 3U);
  };
  const auto size = static_cast<int>(cell.size);
  const glm::ivec3 low(cell.low);
  return {low - size * steps(0), low + size + size * steps(2)};
}

std::vector<OctreeCell> leaf_cells(const Scene& scene) {
  std::vector<OctreeCell> cells(scene.begin_end.size() - 1);
  visit_cells(scene, [&cells](std::uint32_t word, const OctreeCell& cell) {
    if (word >> NODE_TAG_SHIFT == NODE_FILLED) cells[word & NODE_ADDRESS_MASK] = cell;
    return true;
  });
  return cells;
}

std::uint32_t top_levels(std::size_t splats, std::size_t filled_leaves) {
  if (filled_leaves > std::size_t{1} << TOP_LEAF_SHIFT) return 0;
  std::uint32_t levels = 0;
  while (levels < TOP_LEVELS_MOST && std::size_t{1} << 3 * (levels + 1) <= splats) ++levels;
  return levels;
}

std::vector<std::uint32_t> top_table(const Scene& scene, std::uint32_t levels) {
  const std::uint32_t shift = LATTICE_BITS - levels;
  std::vector<std::uint32_t> table(std::size_t{1} << 3 * levels);
  visit_cells(scene, [&](std::uint32_t word, const OctreeCell& cell) {
    const bool inner = word >> NODE_TAG_SHIFT == NODE_INNER;
    if (inner && cell.size > 1U << shift) return true;
    const std::uint32_t level = LATTICE_BITS - static_cast<std::uint32_t>(std::countr_zero(cell.size));
    const std::uint32_t entry = inner ? word : word | level << TOP_LEAF_SHIFT;
    const glm::uvec3 first = cell.low >> shift;
    const std::size_t edge = cell.size >> shift;
    for (std::size_t z = first.z; z < first.z + edge; ++z)
      for (std::size_t y = first.y; y < first.y + edge; ++y)
        std::fill_n(&table[(z << levels | y) << levels | first.x], edge, entry);
    return false;
  });
  return table;
}

}  // namespace splatray
