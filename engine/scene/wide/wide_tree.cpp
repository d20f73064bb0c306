#include "engine/scene/wide/wide_tree.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <thread>
#include <variant>

#include "engine/base/all_cores.h"
#include "engine/scene/pool/pool_table.h"
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

Box box_of(std::span<const uvec4> splats) {
  Box box;
  for (const uvec4& words : splats) box.add(box_of(unpack_splat(words)));
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

template <typename Value>
void gather(Pool<Value>& pool, std::span<const std::uint32_t> order) {
  if (pool.empty()) return;
  std::vector<Value> gathered(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) gathered[i] = pool[order[i]];
  pool = std::move(gathered);
}

/// Brings what lies beside the splats, and themselves, into an order.
void reorder(Scene& scene, std::span<const std::uint32_t> order) {
  for_each_pool([&](const auto& row) {
    if (row.listed()) gather(scene.*row.pool, order);
  });
  for (Column& column : scene.columns)
    std::visit([&](auto& values) { gather(values, order); }, column.values);
  std::vector<std::uint32_t> places(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) places[order[i]] = static_cast<std::uint32_t>(i);
  for (std::uint32_t& reference : scene.reference_pool.edit()) reference = places[reference];
}

/// Which of the children of a node there are, a bit each.
std::uint32_t there_in(const WideLevels& tree, std::uint32_t level, std::uint32_t number) {
  return number == tree.last[level] ? tree.last_mask[level] : (1U << WIDE) - 1U;
}

/// Whether a child's box holds a place.
bool holds(const WideNode& node, std::uint32_t child, const glm::vec3& place) {
  for (int axis = 0; axis < 3; ++axis) {
    const auto& [low, high] = node.bounds[static_cast<std::size_t>(axis)];
    if (!(low[child] <= place[axis] && place[axis] <= high[child])) return false;
  }
  return true;
}

/// Lets equal splats, which lie beside each other among `splats`, keep the order that they came in: of those that a ray meets at once
/// the first is taken, on all devices and whatever the tree.
void keep_order_of_equals(std::span<const uvec4> splats, std::vector<std::uint32_t>& order) {
  if (std::adjacent_find(splats.begin(), splats.end()) == splats.end()) return;
  std::vector<std::uint32_t> place(order.size());
  for (std::uint32_t p = 0; p < order.size(); ++p) place[order[p]] = p;
  for (std::uint32_t first = 0, end = 0; first < splats.size(); first = end) {
    for (end = first + 1; end < splats.size() && splats[end] == splats[first];) ++end;
    std::sort(place.begin() + first, place.begin() + end);
    for (std::uint32_t i = first; i < end; ++i) order[place[i]] = i;
  }
}

}  // namespace

WideLevels wide_levels(std::uint64_t splats) {
  WideLevels tree;
  if (splats == 0) return tree;
  std::uint64_t below = splats, count = 0;
  const auto add_level = [&](std::uint32_t level) {
    count = groups_of(below, WIDE);
    tree.last[level] = static_cast<std::uint32_t>(count - 1);
    tree.last_mask[level] = (1U << (below - WIDE * (count - 1))) - 1U;
    below = count;
  };
  add_level(0);
  do {
    add_level(++tree.levels);
    tree.begin[tree.levels] = tree.nodes;
    tree.nodes += static_cast<std::uint32_t>(count);
  } while (count > 1);
  return tree;
}

std::vector<std::uint32_t> wide_order(std::span<const uvec4> splats, unsigned threads) {
  threads = host_threads(threads);
  std::vector<Item> items(splats.size());
  in_parts(items.size(), threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      items[i] = {glm::vec3(unpack_center(splats[i])), static_cast<std::uint32_t>(i)};
  });
  if (!items.empty()) sort(items, std::size_t{1} << 28U, threads);
  std::vector<std::uint32_t> order;
  order.reserve(items.size());
  for (const Item& item : items) order.push_back(item.splat);
  keep_order_of_equals(splats, order);
  return order;
}

std::vector<WideNode> wide_nodes(std::span<const uvec4> splats, unsigned threads) {
  const WideLevels tree = wide_levels(splats.size());
  std::vector<WideNode> nodes(tree.nodes);
  std::vector<Box> boxes(groups_of(splats.size(), WIDE));
  in_parts(boxes.size(), host_threads(threads), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      boxes[i] = box_of(splats.subspan(i * WIDE, std::min<std::size_t>(WIDE, splats.size() - i * WIDE)));
  });
  for (std::uint32_t level = 1; level <= tree.levels; ++level) {
    std::vector<Box> of_level(tree.last[level] + std::size_t{1});
    for (std::size_t i = 0; i < of_level.size(); ++i)
      of_level[i] =
          fill(nodes[tree.begin[level] + i],
               std::span(boxes).subspan(i * WIDE, std::min<std::size_t>(WIDE, boxes.size() - i * WIDE)));
    boxes = std::move(of_level);
  }
  return nodes;
}

bool has_wide_tree(const Scene& scene) {
  return scene.wide_nodes.size() == wide_levels(scene.data_pool.size()).nodes;
}

void add_wide_tree(Scene& scene, unsigned threads) {
  reorder(scene, wide_order(scene.data_pool, threads));
  scene.wide_nodes = wide_nodes(scene.data_pool, threads);
}

std::optional<std::size_t> find_splat(const Scene& scene, const uvec4& words) {
  const std::span<const uvec4> splats(scene.data_pool);
  std::optional<std::size_t> first;
  const auto find_in = [&](std::size_t begin, std::size_t end) {
    const auto list = splats.subspan(begin, end - begin);
    const auto found = std::find(list.begin(), list.end(), words);
    const auto index = begin + static_cast<std::size_t>(found - list.begin());
    if (found != list.end()) first = std::min(first.value_or(index), index);
  };
  if (!has_wide_tree(scene)) {
    find_in(0, splats.size());
    return first;
  }
  struct Node {
    std::uint32_t level, number;
  };
  const WideLevels tree = wide_levels(splats.size());
  const glm::vec3 place(unpack_center(words));
  std::vector<Node> open;
  if (tree.levels > 0) open.push_back({tree.levels, 0});
  while (!open.empty()) {
    const auto [level, number] = open.back();
    open.pop_back();
    const std::size_t begin = std::size_t{number} * WIDE;
    if (level == 0) {
      find_in(begin, std::min(begin + WIDE, splats.size()));
      continue;
    }
    for (std::uint32_t left = there_in(tree, level, number); left != 0; left &= left - 1) {
      const auto child = static_cast<std::uint32_t>(std::countr_zero(left));
      if (holds(scene.wide_nodes[tree.begin[level] + number], child, place))
        open.push_back({level - 1, static_cast<std::uint32_t>(begin) + child});
    }
  }
  return first;
}

}  // namespace splatray
