/// What stands for the nodes of a scan in levels that are not read.
#pragma once
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "preprocess/base/level_lattice.h"
#include "preprocess/base/levels.h"

namespace splatray {

/// A scan whose levels have means beside points: where a node is read and one below it is not, means of all points there take the
/// place of those few that the nodes above have; where a node is read and has none below it, the points are all there.
class StandIns {
 public:
  /// `chosen`: indices of nodes. `levels` must live as long as this.
  StandIns(const Levels& levels, const std::vector<std::uint32_t>& chosen);

  /// The nodes whose means are read, ascending.
  [[nodiscard]] const std::vector<std::uint32_t>& nodes() const { return nodes_; }
  /// Whether means take the place of a point of a chosen node.
  [[nodiscard]] bool replace(std::uint32_t node, const glm::dvec3& position) const;

 private:
  static constexpr std::uint32_t NONE = LevelNode::NO_PARENT;

  const Levels& levels_;
  LevelLattice lattice_;
  std::vector<bool> is_chosen_;
  std::vector<std::array<std::uint32_t, 8>> children_;  ///< of each node, by the octant's Morton key
  std::vector<std::uint32_t> nodes_;
};

}  // namespace splatray
