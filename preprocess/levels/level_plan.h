/// How points are divided between the parts of an octree that are built one by one, each in memory.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <unordered_map>
#include <vector>

#include "preprocess/base/level_lattice.h"

namespace splatray {

/// A node whose descendants are built together.
struct LevelPart {
  std::uint32_t level = 0;
  glm::uvec3 cell{0};
  std::uint64_t points = 0;

  bool operator==(const LevelPart&) const = default;
};

struct LevelPlan {
  LevelLattice lattice;
  unsigned depth = 0;            ///< the level of the cells that were counted, at most 20
  std::vector<LevelPart> parts;  ///< in Morton order

  /// The part that a place lies in; size of `parts` where it lies in none.
  [[nodiscard]] std::size_t part_of(const glm::uvec3& place) const;
  /// Sets what part_of needs; called when `parts` are there.
  void index();

 private:
  std::vector<std::uint64_t> begins_;  ///< of the parts, Morton keys of the first cell at `depth`
};

/// Counts points in cells whose edges are a power of two, so that no box must be known before; they become coarser as their number grows.
class CellCounts {
 public:
  /// Adds finite positions.
  void add(std::span<const glm::dvec3> positions);
  [[nodiscard]] std::uint64_t points() const { return points_; }
  /// Divides the points into nodes that have at most `most` points each, unless one counted cell alone has more. There must be some.
  [[nodiscard]] LevelPlan plan(std::uint64_t most) const;

 private:
  struct Hash {
    std::size_t operator()(const glm::i64vec3& cell) const;
  };
  using Counts = std::unordered_map<glm::i64vec3, std::uint64_t, Hash>;

  void coarsen();

  int exponent_ = 0;  ///< edges are 2^exponent_
  Counts counts_;
  std::uint64_t points_ = 0;
};

}  // namespace splatray
