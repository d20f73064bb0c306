#include "preprocess/read/tiles/stand_ins.h"

#include "preprocess/base/morton.h"

namespace splatray {

StandIns::StandIns(const Levels& levels, const std::vector<std::uint32_t>& chosen)
    : levels_(levels), lattice_{levels.low, levels.edge}, is_chosen_(levels.nodes.size()) {
  for (const std::uint32_t node : chosen) is_chosen_[node] = true;
  std::array<std::uint32_t, 8> none{};
  none.fill(NONE);
  children_.assign(levels.nodes.size(), none);
  for (std::uint32_t i = 0; i < levels.nodes.size(); ++i) {
    const LevelNode& node = levels.nodes[i];
    if (node.parent == LevelNode::NO_PARENT) continue;
    children_[node.parent][morton_key(node.cell & 1U)] = i;
    if (is_chosen_[node.parent] && !is_chosen_[i]) nodes_.push_back(i);
  }
}

bool StandIns::replace(std::uint32_t node, const glm::dvec3& position) const {
  const glm::uvec3 place = lattice_.place(position);
  while (is_chosen_[node]) {
    const unsigned level = levels_.nodes[node].level + 1;
    if (level > LevelLattice::BITS) return false;
    node = children_[node][morton_key(LevelLattice::cell(place, level) & 1U)];
    if (node == NONE) return false;
  }
  return true;
}

}  // namespace splatray
