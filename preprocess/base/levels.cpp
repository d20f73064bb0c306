#include "preprocess/base/levels.h"

#include <algorithm>

namespace splatray {

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
