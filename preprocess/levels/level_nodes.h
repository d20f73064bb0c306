/// Octrees whose every node has points of its own, coarse ones at the root: each is a sample of what lies below it.
#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "preprocess/levels/level_plan.h"

namespace splatray {

/// A node has at most one point in each of 2^LEVEL_SPAN_BITS cells along its edges, but where it is not divided.
constexpr unsigned LEVEL_SPAN_BITS = 7;
/// Nodes below are not divided: their cells have no room for smaller ones.
constexpr unsigned MOST_LEVEL = LevelLattice::BITS - LEVEL_SPAN_BITS;

/// Numbers of records.
using RecordNumbers = std::vector<std::uint32_t>;

/// A number by chance of a place: near places have others (the finalizer of D. Stafford's Mix13, 2011).
[[nodiscard]] std::uint64_t chance_of(const glm::uvec3& place);

/// Takes from sets of records, those of a node's children, what the node itself has: of each of 128^3 cells of it that has some, one by
/// chance, always the same. They are removed from the sets, each of which keeps one. Places: of all records.
[[nodiscard]] RecordNumbers take_sample(std::span<const glm::uvec3> places, std::uint32_t level,
                                        std::span<RecordNumbers> children);

/// What hears of nodes.
struct NodeListener {
  using Hear = std::function<void(const LevelPart& node, const RecordNumbers& records)>;

  Hear whole;  ///< each node that is not divided, with all records that lie in it
  /// Each node below the top once its records are what they stay, after those below it, and last the top.
  Hear built;
};

/// Builds the octree below `top` of all records; nodes of at most 50 000 are not divided, nor those of MOST_LEVEL.
void build_level_nodes(std::span<const glm::uvec3> places, const LevelPart& top,
                       const NodeListener& listener);

}  // namespace splatray
