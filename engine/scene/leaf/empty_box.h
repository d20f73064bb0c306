/// Boxes of empty space in the octree.
#pragma once
#include <optional>
#include <span>

#include "engine/scene/scene.h"
#include "engine/scene/tree.h"

namespace splatray {

/// An inner node of the octree and its cell.
struct InnerNode {
  std::uint32_t word;
  OctreeCell cell;

  /// Whether the box lies inside the cell.
  [[nodiscard]] bool holds(const OctreeBox& box) const {
    const glm::ivec3 low(cell.low);
    return glm::all(glm::greaterThanEqual(box.low, low)) &&
           glm::all(glm::lessThanEqual(box.high, low + static_cast<int>(cell.size)));
  }
};

/// Whether no filled leaf below a node overlaps the box, which must overlap the node's cell.
[[nodiscard]] bool is_empty(std::span<const std::uint32_t> nodes, const InnerNode& node,
                            const OctreeBox& box);

/// The index in the node pool of the first empty leaf, in Z-order, whose box (empty_box) overlaps a filled leaf or leaves the
/// root; nothing where there is none. The nodes must be a tree of at most MAX_DEPTH levels.
[[nodiscard]] std::optional<std::uint32_t> find_overreaching_leaf(std::span<const std::uint32_t> nodes);

}  // namespace splatray
