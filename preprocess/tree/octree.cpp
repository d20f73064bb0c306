#include "preprocess/tree/octree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <tuple>

#include "engine/base/error.h"
#include "engine/scene/splat.h"
#include "engine/scene/tree.h"
#include "preprocess/base/morton.h"
#include "preprocess/base/parallel.h"
#include "preprocess/base/sorted_order.h"

namespace splatray {
namespace {

bool splat_less(const SplatList& splats, std::uint32_t a, std::uint32_t b) {
  const auto key = [&splats](std::uint32_t i) {
    const uvec4& w = splats.words[i];
    return std::tuple(w.x, w.y, w.z, w.w, splats.color.empty() ? 0U : splats.color[i],
                      splats.field.empty() ? 0U : splats.field[i], splats.clip.empty() ? 0U : splats.clip[i],
                      splats.point.empty() ? 0U : splats.point[i]);
  };
  return key(a) < key(b);
}

/// Makes splats those of the order.
void take(SplatList& splats, const std::vector<std::uint32_t>& order) {
  splats.key = gather(splats.key, order);
  splats.words = gather(splats.words, order);
  splats.color = gather(splats.color, order);
  splats.field = gather(splats.field, order);
  splats.clip = gather(splats.clip, order);
  splats.point = gather(splats.point, order);
}

/// Keeps the first `copies` of equal words, which are next to each other. Returns how many splats it dropped.
std::uint64_t drop_surplus(SplatList& splats, std::uint32_t copies) {
  const auto is_surplus = [&](std::size_t i) {
    return i >= copies && splats.words[i] == splats.words[i - copies];
  };
  const std::uint64_t before = splats.size();
  const auto kept = numbers_where(before, [&](std::size_t i) { return !is_surplus(i); });
  if (kept.size() < before) take(splats, kept);
  return before - kept.size();
}

class Builder {
 public:
  Builder(const SplatList& splats, std::uint32_t leaf_size, std::span<const CellName> divided)
      : splats_(splats), leaf_size_(leaf_size), divided_(divided) {}

  Octree build() {
    tree_.node_pool.push_back(0);
    fill({0, 0, 0, 0, static_cast<std::uint32_t>(splats_.size())}, nullptr);
    return std::move(tree_);
  }

  Octree build_in(const std::vector<OctreeBox>& boxes) {
    tree_.node_pool.push_back(0);
    fill({0, 0, 0, 0, static_cast<std::uint32_t>(splats_.size())}, &boxes);
    return std::move(tree_);
  }

 private:
  using Boxes = std::vector<OctreeBox>;

  /// Writes the word of a node, given as the leaf it would be, and everything below it; `boxes`, where there are any, are those
  /// that overlap its parent.
  void fill(const Leaf& node, const Boxes* boxes) {
    Boxes inside;
    if (boxes != nullptr) {
      inside = boxes_in(node, *boxes);
      boxes = &inside;
    }
    if ((boxes != nullptr && boxes->empty()) || !is_divided(node)) {
      const std::uint32_t tag = node.begin < node.end ? NODE_FILLED : NODE_EMPTY;
      tree_.node_pool[node.node] = tag << NODE_TAG_SHIFT | static_cast<std::uint32_t>(tree_.leaves.size());
      tree_.leaves.push_back(node);
      return;
    }
    const std::size_t first_child = tree_.node_pool.size();
    if (first_child + 8 > NODE_ADDRESS_MASK) {
      throw Error(ExitCode::failed,
                  "the octree needs more than 2^30 nodes; use fewer points or a larger leaf size");
    }
    tree_.node_pool[node.node] = NODE_INNER << NODE_TAG_SHIFT | static_cast<std::uint32_t>(first_child);
    tree_.node_pool.resize(first_child + 8);
    const std::uint64_t child_keys = 1ULL << 3 * (LATTICE_BITS - node.level - 1);
    Leaf child{node.key, static_cast<std::uint32_t>(first_child), node.level + 1, node.begin, node.begin};
    for (int i = 0; i < 8; ++i) {
      const auto from = splats_.key.begin() + child.begin;
      child.end = i == 7 ? node.end
                         : static_cast<std::uint32_t>(std::lower_bound(from, splats_.key.begin() + node.end,
                                                                       child.key + child_keys) -
                                                      splats_.key.begin());
      fill(child, boxes);
      child.key += child_keys;
      child.begin = child.end;
      ++child.node;
    }
  }

  static Boxes boxes_in(const Leaf& node, const Boxes& boxes) {
    const glm::ivec3 low(morton_point(node.key));
    const glm::ivec3 high = low + static_cast<int>(node.cell_size());
    Boxes inside;
    std::copy_if(boxes.begin(), boxes.end(), std::back_inserter(inside), [&](const OctreeBox& box) {
      return glm::all(glm::lessThan(box.low, high)) && glm::all(glm::greaterThan(box.high, low));
    });
    return inside;
  }

  [[nodiscard]] bool is_divided(const Leaf& node) const {
    const std::uint32_t centers = node.end - node.begin;
    if (node.level == MAX_DEPTH) return false;
    if (std::binary_search(divided_.begin(), divided_.end(), CellName{node.key, node.level})) return true;
    if (centers <= leaf_size_) return false;
    if (centers > CROWDED_MOST * leaf_size_) return true;
    return !are_wide(
        splats_, centers, [&](std::size_t i) { return node.begin + i; }, node.cell_size());
  }

  const SplatList& splats_;
  std::uint32_t leaf_size_;
  std::span<const CellName> divided_;
  Octree tree_;
};

}  // namespace

std::uint64_t order_splats(SplatList& splats, std::uint32_t copies) {
  take(splats, sorted_order(
                   splats.size(), [&](std::size_t i) { return splats.key[i]; },
                   [&](std::uint32_t a, std::uint32_t b) { return splat_less(splats, a, b); }));
  return drop_surplus(splats, copies);
}

Octree build_octree(const SplatList& splats, std::uint32_t leaf_size, std::span<const CellName> divided) {
  return Builder(splats, leaf_size, divided).build();
}

Octree build_octree_in(const SplatList& splats, std::uint32_t leaf_size,
                       const std::vector<OctreeBox>& boxes) {
  return Builder(splats, leaf_size, {}).build_in(boxes);
}

}  // namespace splatray
