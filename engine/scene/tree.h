/// The octree of a scene: cells, empty boxes, the table of its top levels.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "engine/scene/scene.h"

namespace splatray {

/// A cell of the octree, lattice units.
struct OctreeCell {
  glm::uvec3 low{0};
  std::uint32_t size = 0;
};

/// A part of the root, lattice units; `high` is outside.
struct OctreeBox {
  glm::ivec3 low{0};
  glm::ivec3 high{0};
};

/// The box without filled leaves around an empty leaf, from its node word: the reference implementation of the decoding.
[[nodiscard]] OctreeBox empty_box(std::uint32_t word, const OctreeCell& cell);

/// The cell of a child, 0 to 7 in Z-order.
[[nodiscard]] inline OctreeCell child_cell(const OctreeCell& cell, std::uint32_t child) {
  const std::uint32_t half = cell.size / 2;
  return {cell.low + half * glm::uvec3(child & 1U, child >> 1 & 1U, child >> 2), half};
}

/// Calls visit(node word, OctreeCell) for the root and, where that returns true for an inner node, for its children in Z-order, and
/// so on.
template <typename Visit>
void visit_cells(const Scene& scene, const Visit& visit, std::uint32_t node = 0,
                 const OctreeCell& cell = {glm::uvec3(0), 1U << LATTICE_BITS}) {
  const std::uint32_t word = scene.node_pool[node];
  if (!visit(word, cell) || word >> NODE_TAG_SHIFT != NODE_INNER) return;
  for (std::uint32_t child = 0; child < 8; ++child)
    visit_cells(scene, visit, (word & NODE_ADDRESS_MASK) + child, child_cell(cell, child));
}

/// The cells of the filled leaves, in the order of Begin-End; size 0 for leaves that are not in the tree.
[[nodiscard]] std::vector<OctreeCell> leaf_cells(const Scene& scene);

/// Levels of the top table that suits a scene: as many as leave it no more entries than splats. None where a leaf's address
/// has no place beside its level.
[[nodiscard]] std::uint32_t top_levels(std::size_t splats, std::size_t filled_leaves);
/// The top table of the node pool (layout.h), 8^levels entries; levels as above or fewer.
[[nodiscard]] std::vector<std::uint32_t> top_table(const Scene& scene, std::uint32_t levels);

}  // namespace splatray
