#include "preprocess/tree/empty_space.h"

#include <array>
#include <utility>
#include <vector>

#include "engine/scene/leaf/empty_box.h"
#include "engine/scene/tree.h"

namespace splatray {
namespace {

/// Subtrees of cells of this size are looked at in parallel.
constexpr std::uint32_t TASK_SIZE = 1U << (LATTICE_BITS - 4);

/// What the box would gain by one step of `step` on a side: 0 -x, 1 +x, 2 -y, 3 +y, 4 -z, 5 +z.
OctreeBox layer_of(const OctreeBox& box, int side, int step) {
  const int axis = side / 2;
  OctreeBox layer = box;
  if (side % 2 == 0) {
    layer.high[axis] = box.low[axis];
    layer.low[axis] -= step;
  } else {
    layer.low[axis] = box.high[axis];
    layer.high[axis] += step;
  }
  return layer;
}

/// The address bits of an empty leaf with this cell. `path` leads from the root to its parent.
std::uint32_t grown_word(std::span<const std::uint32_t> nodes, const OctreeCell& cell,
                         const std::vector<InnerNode>& path) {
  if (path.empty()) return 0;  // the root is empty itself: there is nothing to reach
  const auto step = static_cast<int>(cell.size);
  OctreeBox box{glm::ivec3(cell.low), glm::ivec3(cell.low) + step};
  std::array<std::uint32_t, 6> steps{};
  std::uint32_t open = 0x3FU;
  std::size_t parent = path.size() - 1;
  for (int side = 0; open != 0; side = (side + 1) % 6) {
    if ((open >> side & 1U) == 0) continue;
    const OctreeBox layer = layer_of(box, side, step);
    while (parent > 0 && !path[parent].holds(layer)) --parent;
    if (path[parent].holds(layer) && is_empty(nodes, path[parent], layer)) {
      box = {glm::min(box.low, layer.low), glm::max(box.high, layer.high)};
      if (++steps[static_cast<std::size_t>(side)] < EMPTY_STEPS_MOST) continue;
    }
    open &= ~(1U << side);
  }
  std::uint32_t word = 0;
  for (std::size_t side = 0; side < steps.size(); ++side) word |= steps[side] << (2 * side);
  return word;
}

/// A part of the tree, and the way from the root to the parent of its node.
struct Subtree {
  std::uint32_t node;
  OctreeCell cell;
  std::vector<InnerNode> path;
};

/// Cuts the tree into parts that lie in cells of at most TASK_SIZE, or are leaves.
void cut(std::span<const std::uint32_t> nodes, const Subtree& tree, std::vector<Subtree>& parts) {
  const std::uint32_t word = nodes[tree.node];
  if (tree.cell.size <= TASK_SIZE || word >> NODE_TAG_SHIFT != NODE_INNER) {
    parts.push_back(tree);
    return;
  }
  std::vector<InnerNode> path = tree.path;
  path.push_back({word, tree.cell});
  for (std::uint32_t child = 0; child < 8; ++child)
    cut(nodes, {(word & NODE_ADDRESS_MASK) + child, child_cell(tree.cell, child), path}, parts);
}

/// Writes into `grown` the words of a node's empty leaves.
void grow_below(std::span<const std::uint32_t> nodes, std::uint32_t node, const OctreeCell& cell,
                std::vector<InnerNode>& path, std::vector<std::uint32_t>& grown) {
  const std::uint32_t word = nodes[node];
  if (word >> NODE_TAG_SHIFT == NODE_EMPTY) grown[node] |= grown_word(nodes, cell, path);
  if (word >> NODE_TAG_SHIFT != NODE_INNER) return;
  path.push_back({word, cell});
  for (std::uint32_t child = 0; child < 8; ++child)
    grow_below(nodes, (word & NODE_ADDRESS_MASK) + child, child_cell(cell, child), path, grown);
  path.pop_back();
}

}  // namespace

void grow_empty_leaves(Scene& scene, const Stage& stage) {
  std::vector<std::uint32_t> grown(scene.node_pool.begin(), scene.node_pool.end());
  std::vector<Subtree> parts;
  cut(scene.node_pool, {0, {glm::uvec3(0), 1U << LATTICE_BITS}, {}}, parts);
  parallel_each(
      stage, parts.size(),
      [&](std::size_t i) { grow_below(scene.node_pool, parts[i].node, parts[i].cell, parts[i].path, grown); },
      1);
  scene.node_pool = std::move(grown);
}

}  // namespace splatray
