#include "preprocess/base/levels.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <unordered_map>

namespace splatray {
namespace {

/// A cube of the octree: its level, and its place there.
using Key = std::array<std::uint32_t, 4>;

struct HashOfKey {
  std::size_t operator()(const Key& key) const {
    std::uint64_t hash = 0;
    for (const std::uint32_t number : key) hash = (hash ^ number) * 0x9E3779B97F4A7C15ULL;
    return static_cast<std::size_t>(hash ^ (hash >> 32U));
  }
};

}  // namespace

bool LevelNode::lies_in_octree() const {
  return level <= MOST_LEVEL && (std::max({cell.x, cell.y, cell.z}) >> level) == 0;
}

std::uint64_t Levels::points() const {
  std::uint64_t sum = 0;
  for (const LevelNode& node : nodes) sum += node.points;
  return sum;
}

std::uint32_t Levels::depth() const {
  std::uint32_t deepest = 0;
  for (const LevelNode& node : nodes) deepest = std::max(deepest, node.level + 1);
  return deepest;
}

LoadCount::LoadCount(const Levels& levels)
    : levels_(levels), means_below_(levels.nodes.size()), is_counted_(levels.nodes.size()) {
  for (const LevelNode& node : levels.nodes)
    if (node.parent != LevelNode::NO_PARENT) means_below_[node.parent] += node.means;
}

void LoadCount::add(std::uint32_t node) {
  const auto count_points = [&](std::uint32_t one) {
    if (!is_counted_[one]) sum_ += levels_.nodes[one].points;
    is_counted_[one] = true;
  };
  sum_ += means_below_[node];
  if (means_below_[node] == 0) count_points(node);
  if (const LevelNode& added = levels_.nodes[node]; added.parent != LevelNode::NO_PARENT) {
    sum_ -= added.means;
    count_points(added.parent);
  }
}

std::optional<std::string> link_levels(std::vector<LevelNode>& nodes) {
  const auto order = [](const LevelNode& node) {
    return std::tuple(node.level, node.cell.x, node.cell.y, node.cell.z);
  };
  std::sort(nodes.begin(), nodes.end(),
            [&](const LevelNode& a, const LevelNode& b) { return order(a) < order(b); });
  std::unordered_map<Key, std::uint32_t, HashOfKey> places;
  for (std::uint32_t i = 0; i < nodes.size(); ++i) {
    LevelNode& node = nodes[i];
    if (!places.emplace(Key{node.level, node.cell.x, node.cell.y, node.cell.z}, i).second)
      return "a node twice";
    if (node.level == 0) continue;
    const auto parent =
        places.find({node.level - 1, node.cell.x >> 1U, node.cell.y >> 1U, node.cell.z >> 1U});
    if (parent == places.end()) return "a node without its parent";
    node.parent = parent->second;
  }
  return std::nullopt;
}

std::vector<std::uint32_t> first_levels(const Levels& levels, std::uint64_t points) {
  std::vector<std::uint64_t> of_level(levels.depth());
  for (const LevelNode& node : levels.nodes) of_level[node.level] += node.points;
  std::uint32_t depth = 0;
  for (std::uint64_t sum = 0; depth < of_level.size() && sum < points; ++depth) sum += of_level[depth];
  std::vector<std::uint32_t> chosen;
  for (std::uint32_t i = 0; i < levels.nodes.size(); ++i)
    if (levels.nodes[i].level < depth) chosen.push_back(i);
  return chosen;
}

}  // namespace splatray
