#include "preprocess/tree/empty_space.h"

#include <array>
#include <bit>
#include <cassert>
#include <utility>
#include <vector>

namespace splatray {
namespace {

/// Subtrees of cells of this size are looked at in parallel.
constexpr std::uint32_t TASK_SIZE = 1U << (LATTICE_BITS - 4);

/// An inner node on the way to a leaf.
struct Ancestor {
  std::uint32_t word;
  OctreeCell cell;

  [[nodiscard]] bool holds(const OctreeBox& box) const {
    const glm::ivec3 low(cell.low);
    return glm::all(glm::greaterThanEqual(box.low, low)) &&
           glm::all(glm::lessThanEqual(box.high, low + static_cast<int>(cell.size)));
  }
};

/// Children, a bit each, whose cells overlap a box that overlaps their parent's.
std::uint32_t children_in(const OctreeCell& cell, const OctreeBox& box) {
  const glm::ivec3 middle = glm::ivec3(cell.low) + static_cast<int>(cell.size / 2);
  const std::uint32_t x = (box.low.x < middle.x ? 0x55U : 0U) | (box.high.x > middle.x ? 0xAAU : 0U);
  const std::uint32_t y = (box.low.y < middle.y ? 0x33U : 0U) | (box.high.y > middle.y ? 0xCCU : 0U);
  const std::uint32_t z = (box.low.z < middle.z ? 0x0FU : 0U) | (box.high.z > middle.z ? 0xF0U : 0U);
  return x & y & z;
}

/// Whether no filled leaf below an inner node overlaps the box.
bool is_empty(const std::vector<std::uint32_t>& nodes, const Ancestor& node, const OctreeBox& box) {
  const std::uint32_t first = node.word & NODE_ADDRESS_MASK;
  std::uint32_t inner = 0;
  for (std::uint32_t left = children_in(node.cell, box); left != 0; left &= left - 1) {
    const auto child = static_cast<std::uint32_t>(std::countr_zero(left));
    const std::uint32_t tag = nodes[first + child] >> NODE_TAG_SHIFT;
    if (tag == NODE_FILLED) return false;
    if (tag == NODE_INNER) inner |= 1U << child;
  }
  for (; inner != 0; inner &= inner - 1) {
    const auto child = static_cast<std::uint32_t>(std::countr_zero(inner));
    if (!is_empty(nodes, {nodes[first + child], child_cell(node.cell, child)}, box)) return false;
  }
  return true;
}

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
std::uint32_t grown_word(const std::vector<std::uint32_t>& nodes, const OctreeCell& cell,
                         const std::vector<Ancestor>& path) {
  assert(!path.empty());  // the root is never empty
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
  std::vector<Ancestor> path;
};

/// Cuts the tree into parts that lie in cells of at most TASK_SIZE, or are leaves.
void cut(const std::vector<std::uint32_t>& nodes, const Subtree& tree, std::vector<Subtree>& parts) {
  const std::uint32_t word = nodes[tree.node];
  if (tree.cell.size <= TASK_SIZE || word >> NODE_TAG_SHIFT != NODE_INNER) {
    parts.push_back(tree);
    return;
  }
  std::vector<Ancestor> path = tree.path;
  path.push_back({word, tree.cell});
  for (std::uint32_t child = 0; child < 8; ++child)
    cut(nodes, {(word & NODE_ADDRESS_MASK) + child, child_cell(tree.cell, child), path}, parts);
}

/// Writes into `grown` the words of a node's empty leaves.
void grow_below(const std::vector<std::uint32_t>& nodes, std::uint32_t node, const OctreeCell& cell,
                std::vector<Ancestor>& path, std::vector<std::uint32_t>& grown) {
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
  std::vector<std::uint32_t> grown = scene.node_pool;
  std::vector<Subtree> parts;
  cut(scene.node_pool, {0, {glm::uvec3(0), 1U << LATTICE_BITS}, {}}, parts);
  parallel_each(
      stage, parts.size(),
      [&](std::size_t i) { grow_below(scene.node_pool, parts[i].node, parts[i].cell, parts[i].path, grown); },
      1);
  scene.node_pool = std::move(grown);
}

}  // namespace splatray
