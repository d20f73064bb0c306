/// Octrees whose every node has points of its own, coarse ones at the root: each is a sample of what lies below it.
#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "preprocess/levels/level_plan.h"

namespace splatray {

/// Numbers of records.
using RecordNumbers = std::vector<std::uint32_t>;

/// Takes from sets of records, those of a node's children, what the node itself has: of each of 128^3 cells of it that has some, one by
/// chance, always the same. They are removed from the sets, each of which keeps one. Places: of all records.
[[nodiscard]] RecordNumbers take_sample(std::span<const glm::uvec3> places, std::uint32_t level,
                                        std::span<RecordNumbers> children);

/// Called with each node below the top once its records are what they stay, and last with the top.
using NodeListener = std::function<void(const LevelPart& node, const RecordNumbers& records)>;

/// Builds the octree below `top` of all records; nodes of at most 50 000 are not divided (nor cells of 1/128 of a node's edge that have
/// no room for smaller ones).
void build_level_nodes(std::span<const glm::uvec3> places, const LevelPart& top,
                       const NodeListener& listener);

}  // namespace splatray
