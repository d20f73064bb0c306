/// Cells that find boxes of any sizes.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <unordered_map>
#include <vector>

#include "preprocess/base/bounds.h"
#include "preprocess/base/morton.h"

namespace splatray {

/// Boxes in the cells of several grids, each of twice the width of the one before: each box in the finest whose cells are as wide as half
/// its longest side.
class BoxCells {
 public:
  BoxCells() = default;
  /// `finest_world`: the least width of a cell; wider where a grid of them would have more than 2^19 along a side.
  BoxCells(const std::vector<Bounds>& boxes, double finest_world);

  /// Boxes of a cell beyond so many are not found: a file may have all of its boxes in one place, and what looks for each would take hours.
  static constexpr std::uint32_t MOST_OF_CELL = 1U << 12;

  /// Calls visit(number of the box) for each in a cell that the box from `low` to `high` meets: all that overlap it, some beside it, and
  /// one in several cells as often.
  template <class Visit>
  void each_near(const glm::dvec3& low, const glm::dvec3& high, const Visit& visit) const {
    for (int level = 0; level < levels_; ++level) {
      const glm::ivec3 first = cell_of(low, level), last = cell_of(high, level);
      for (int x = first.x; x <= last.x; ++x)
        for (int y = first.y; y <= last.y; ++y)
          for (int z = first.z; z <= last.z; ++z) {
            const auto cell = cells_.find(key_of(level, {x, y, z}));
            if (cell == cells_.end()) continue;
            for (std::uint32_t at = cell->second.begin; at < cell->second.end; ++at) visit(in_cells_[at]);
          }
    }
  }

 private:
  static constexpr int CELL_BITS = 19;  // of each coordinate, below the level's bits
  static constexpr int CELLS = 1 << CELL_BITS;
  struct Range {
    std::uint32_t begin, end;
  };

  [[nodiscard]] static std::uint64_t key_of(int level, const glm::ivec3& cell) {
    return static_cast<std::uint64_t>(level) << (3 * CELL_BITS) | morton_key(glm::uvec3(cell));
  }
  /// The nearest cell there is.
  [[nodiscard]] glm::ivec3 cell_of(const glm::dvec3& place_world, int level) const {
    return glm::clamp(glm::floor((place_world - origin_world_) / std::ldexp(finest_world_, level)), 0.0,
                      CELLS - 1.0);
  }

  glm::dvec3 origin_world_{0.0};
  double finest_world_ = 1.0;
  int levels_ = 0;
  std::unordered_map<std::uint64_t, Range> cells_;
  std::vector<std::uint32_t> in_cells_;
};

}  // namespace splatray
