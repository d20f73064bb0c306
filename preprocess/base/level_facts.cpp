#include "preprocess/base/level_facts.h"

#include <string>

#include "engine/base/number_text.h"

namespace splatray {

void add_level_facts(const Levels& levels, std::string_view kind, std::vector<FileFact>& facts) {
  if (levels.nodes.empty()) return;
  std::vector<std::uint64_t> points(levels.depth());
  for (const LevelNode& node : levels.nodes) points[node.level] += node.points;
  std::string text = std::to_string(levels.nodes.size()) + " nodes, points by level";
  for (const std::uint64_t count : points) text += ' ' + std::to_string(count);
  facts.push_back({"levels", text + " (" + std::string(kind) + ")"});
  facts.push_back({"octree", number_text(levels.low, ' ') + ", edge " + number_text(levels.edge)});
}

}  // namespace splatray
