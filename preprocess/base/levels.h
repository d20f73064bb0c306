/// Files whose points are in levels: an octree of nodes, each with points of its own, the union of which is the scan.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace splatray {

/// The column that shows Points::mean_of, where the file has no attribute of this name.
inline constexpr const char* COLUMN_POINT_COUNT = "PointCount";

/// A cube with some of the points that lie in it; its children have others, which are nearer to each other.
struct LevelNode {
  static constexpr std::uint32_t NO_PARENT = std::numeric_limits<std::uint32_t>::max();
  static constexpr std::uint32_t MOST_LEVEL = 31;  ///< cells of a level are counted with as many bits

  std::uint32_t level = 0;              ///< 0 = the root, whose edge is 2^level of this node's
  glm::uvec3 cell{0};                   ///< its cube among those of its level, from the lowest corner on
  std::uint32_t parent = NO_PARENT;     ///< index of a node before this one
  std::uint64_t points = 0;             ///< of its own; 0: its descendants alone have some
  std::uint64_t offset = 0, bytes = 0;  ///< of these points in the file; 0: each node is a file of its own
  std::uint64_t means = 0;              ///< that stand for all points in it where it is not read; 0: none do

  /// Whether its level has such a cell.
  [[nodiscard]] bool lies_in_octree() const;
};

struct Levels {
  glm::dvec3 low{0.0};           ///< lowest corner of the root's cube, in the file's coordinates
  double edge = 0.0;             ///< of it
  std::vector<LevelNode> nodes;  ///< parents before their children

  [[nodiscard]] std::uint64_t points() const;
  [[nodiscard]] std::uint32_t depth() const;  ///< levels that have nodes, 0 without any
};

/// How much is loaded of a scan of which some nodes are read: their points, and the means of those nodes below them that are not, which take
/// the place of points that the nodes above have there.
class LoadCount {
 public:
  /// `levels` must live as long as this.
  explicit LoadCount(const Levels& levels);

  /// A node is read, too, after the one above it.
  void add(std::uint32_t node);
  /// Never less than that: of a node all points count unless means stand for every node below it.
  [[nodiscard]] std::uint64_t sum() const { return sum_; }

 private:
  const Levels& levels_;
  std::vector<std::uint64_t> means_below_;  ///< of each node, those of its children
  std::vector<bool> is_counted_;            ///< whether a node's points are
  std::uint64_t sum_ = 0;
};

/// Puts nodes that a directory names in any order before their children, which know them then. Returns what it found where they are no
/// octree: "a node twice", "a node without its parent".
[[nodiscard]] std::optional<std::string> link_levels(std::vector<LevelNode>& nodes);

/// The nodes of the first levels that together have at least `points` points, or all.
[[nodiscard]] std::vector<std::uint32_t> first_levels(const Levels& levels, std::uint64_t points);

}  // namespace splatray
