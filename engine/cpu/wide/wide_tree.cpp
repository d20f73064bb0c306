#include "engine/cpu/wide/wide_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <thread>

#include "engine/cpu/run_groups.h"
#include "engine/scene/splat.h"

namespace splatray {
namespace {

/// Boxes are that much larger on each side, lattice units: more than float32 takes from a plane's t, times the direction, plus
/// what a ray's origin loses of its double-float.
constexpr float BOX_SLACK = 2.0F;

struct Item {
  glm::vec3 center;
  std::uint32_t splat;
};

/// Runs work(begin, end) on parts of 0 .. count - 1.
template <class Work>
void in_parts(std::size_t count, unsigned threads, const Work& work) {
  std::vector<std::jthread> others;
  for (unsigned i = 1; i < threads; ++i)
    others.emplace_back([&work, count, threads, i] { work(count * i / threads, count * (i + 1) / threads); });
  work(0, count / threads);
}

std::uint32_t groups_of(std::size_t count, std::size_t size) {
  return static_cast<std::uint32_t>((count + size - 1) / size);
}

int longest_axis(std::span<const Item> items) {
  glm::vec3 low(INFINITY), high(-INFINITY);
  for (const Item& item : items) {
    low = glm::min(low, item.center);
    high = glm::max(high, item.center);
  }
  const glm::vec3 size = high - low;
  return size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
}

/// Puts the items of each of the tree's nodes beside each other: halves along the longest side, the first of them whole children
/// of `child` items.
void sort(std::span<Item> items, std::size_t child, unsigned threads) {
  while (child >= items.size()) child /= WIDE;
  if (child < WIDE) return;
  const std::size_t middle = groups_of(items.size(), child) / 2 * child;
  const int axis = longest_axis(items);
  std::nth_element(items.begin(), items.begin() + std::ptrdiff_t(middle), items.end(),
                   [axis](const Item& a, const Item& b) { return a.center[axis] < b.center[axis]; });
  const unsigned half = threads / 2;
  std::jthread other;
  if (half > 0) other = std::jthread([=] { sort(items.first(middle), child, half); });
  if (half == 0) sort(items.first(middle), child, 1);
  sort(items.subspan(middle), child, std::max(threads - half, 1U));
}

/// The box of a leaf or a node.
struct Box {
  glm::vec3 low{INFINITY}, high{-INFINITY};

  void add(const Box& box) {
    low = glm::min(low, box.low);
    high = glm::max(high, box.high);
  }
};

Box box_of(const Splat& splat) {
  const glm::dvec3 reach =
      std::sqrt(splat.radius_squared) * glm::sqrt(glm::max(1.0 - splat.normal * splat.normal, 0.0));
  return {glm::vec3(splat.center - reach) - BOX_SLACK, glm::vec3(splat.center + reach) + BOX_SLACK};
}

/// Fills a leaf; returns its box.
Box fill(WideLeaf& leaf, std::span<const Item> items, std::span<const uvec4> splats) {
  Box box;
  leaf = {};
  for (std::size_t i = 0; i < items.size(); ++i) {
    const uvec4& words = splats[items[i].splat];
    for (int word = 0; word < 4; ++word) leaf.words[static_cast<std::size_t>(word)][i] = words[word];
    box.add(box_of(unpack_splat(words)));
  }
  return box;
}

/// Fills a node; returns its box.
Box fill(WideNode& node, std::span<const Box> children) {
  Box all;
  for (std::size_t i = 0; i < WIDE; ++i) {
    const Box box = i < children.size() ? children[i] : Box{};
    for (int axis = 0; axis < 3; ++axis) {
      node.bounds[axis][0][i] = box.low[axis];
      node.bounds[axis][1][i] = box.high[axis];
    }
    all.add(box);
  }
  return all;
}

}  // namespace

WideTree::WideTree(std::span<const uvec4> splats, unsigned threads, std::vector<std::uint32_t>& order) {
  order.clear();
  if (splats.empty()) return;
  threads = host_threads(threads);
  std::vector<Item> items(splats.size());
  in_parts(items.size(), threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      items[i] = {glm::vec3(unpack_center(splats[i])), static_cast<std::uint32_t>(i)};
  });
  sort(items, std::size_t{1} << 28U, threads);
  order.reserve(items.size());
  for (const Item& item : items) order.push_back(item.splat);
  std::vector<Box> boxes(groups_of(items.size(), WIDE));
  leaves_.resize(boxes.size());
  in_parts(leaves_.size(), threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t first = i * WIDE;
      const auto mine = std::span(items).subspan(first, std::min<std::size_t>(WIDE, items.size() - first));
      boxes[i] = fill(leaves_[i], mine, splats);
    }
  });
  view_.last_leaf = groups_of(items.size(), WIDE) - 1;
  view_.last_mask = (1U << (items.size() - std::size_t{view_.last_leaf} * WIDE)) - 1U;
  do {
    const std::uint32_t count = groups_of(boxes.size(), WIDE);
    const std::size_t level = nodes_.size();
    view_.level_begin[++view_.levels] = static_cast<std::uint32_t>(level);
    nodes_.resize(level + count);
    std::vector<Box> of_level(count);
    for (std::size_t i = 0; i < count; ++i) {
      const auto children =
          std::span(boxes).subspan(i * WIDE, std::min<std::size_t>(WIDE, boxes.size() - i * WIDE));
      of_level[i] = fill(nodes_[level + i], children);
    }
    boxes = std::move(of_level);
  } while (boxes.size() > 1);
}

WideView WideTree::view() const {
  WideView view = view_;
  view.nodes = nodes_.data();
  view.leaves = leaves_.data();
  return view;
}

std::uint64_t WideTree::bytes() const {
  return leaves_.size() * sizeof(WideLeaf) + nodes_.size() * sizeof(WideNode);
}

}  // namespace splatray
