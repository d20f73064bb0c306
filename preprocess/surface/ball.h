/// What lies within some distance of a few queries that are near each other: one walk through the tree for all of them.
#pragma once
#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>

#include "preprocess/base/lanes.h"
#include "preprocess/surface/neighbours.h"

namespace splatray {

[[gnu::always_inline]] inline void NeighbourSearch::Block::measure(const glm::vec3& query,
                                                                   float* distance) const {
  Lanes dx, dy, dz;
  load_lanes(x, dx), load_lanes(y, dy), load_lanes(z, dz);
  dx -= query.x, dy -= query.y, dz -= query.z;
  const Lanes squared = dx * dx + dy * dy + dz * dz;
  store_lanes(squared, distance);
}

/// The blocks that come within some distance of a box of queries, so that all sites near these are among theirs. Everything
/// is compiled into its callers, so that these can be cloned for wider vectors.
class NeighbourSearch::Ball {
 public:
  [[gnu::always_inline]] Ball(const NeighbourSearch& search, const glm::vec3& low, const glm::vec3& high,
                              float reach_squared)
      : search_(&search), low_(low), high_(high), reach_squared_(reach_squared) {
    count_ = search.blocks_.empty() ? 0 : 1;
    nodes_[0] = 0;
    for (std::size_t level = search.levels_.size(); level-- > 0 && count_ > 0;) descend(level);
    take_boxes();
  }

  [[nodiscard]] float reach_squared() const { return reach_squared_; }

  /// Finds as many of the nearest sites at a squared distance of at most `reach_squared`, itself at most the ball's, as there
  /// are, at most nearest.size(), and returns how many; nothing where there are too many to count. They ascend, but where there
  /// are no more than asked for and `ordered` is false.
  [[nodiscard, gnu::always_inline]] std::optional<std::size_t> collect(const glm::vec3& query,
                                                                       std::span<Neighbour> nearest,
                                                                       float reach_squared,
                                                                       bool ordered) const {
    if (!complete_) return {};
    std::uint32_t blocks[MOST_NODES + LANES];
    const std::size_t count = choose_blocks(query, reach_squared, blocks);
    Sites near;
    near.count = 0;
    for (std::size_t i = 0; i < count; ++i) {
      if (near.count > MOST_SITES - WIDTH) return {};
      near.add(search_->blocks_[blocks[i]], query, reach_squared);
    }
    if (ordered || near.count > nearest.size()) return near.sort(nearest);
    for (std::size_t i = 0; i < near.count; ++i) nearest[i] = Neighbour(near.distance[i], near.index[i]);
    return near.count;
  }

 private:
  static constexpr std::size_t MOST_NODES = 256;
  static constexpr float INFINITE = std::numeric_limits<float>::infinity();
  static constexpr std::size_t MOST_SITES = 192;
  static constexpr std::size_t MANY = 5;  // vectors of a size that most searches of 32 neighbours need
  static constexpr std::size_t FEW = 2;   // the same of 12

  /// Sites within reach of a query.
  struct Sites {
    std::size_t count;
    float distance[MOST_SITES + MANY * LANES];
    std::uint32_t index[MOST_SITES + WIDTH];

    /// Adds those of a block that are near, but not at the query. Bits of floats >= 0 order like their values; less 1, zero
    /// is the largest.
    [[gnu::always_inline]] void add(const Block& block, const glm::vec3& query, float reach_squared) {
      const auto reach_bits = std::bit_cast<std::uint32_t>(reach_squared);
      float distances[WIDTH];
      block.measure(query, distances);
      for (std::uint32_t j = 0; j < WIDTH; ++j) {
        distance[count] = distances[j];
        index[count] = block.index[j];
        count += static_cast<std::size_t>(std::bit_cast<std::uint32_t>(distances[j]) - 1U < reach_bits);
      }
    }

    /// Counts for SOME * LANES sites from `first` on how many of all are nearer.
    template <std::size_t SOME>
    [[gnu::always_inline]] std::size_t rank(std::size_t first, std::int32_t* ranks) const {
      Lanes values[SOME];
      LaneInts nearer[SOME];
      for (std::size_t k = 0; k < SOME; ++k)
        load_lanes(distance + first + k * LANES, values[k]), nearer[k] = LaneInts{};
      for (std::size_t j = 0; j < count; ++j)
        for (std::size_t k = 0; k < SOME; ++k) nearer[k] -= distance[j] < values[k];  // true is -1
      for (std::size_t k = 0; k < SOME; ++k)
        std::memcpy(ranks + first + k * LANES, &nearer[k], sizeof nearer[k]);
      return SOME * LANES;
    }

    /// Gives the nearest, ascending; returns how many.
    [[gnu::always_inline]] std::size_t sort(std::span<Neighbour> nearest) {
      std::fill_n(distance + count, MANY * LANES, INFINITE);  // what is loaded too
      std::int32_t ranks[MOST_SITES + MANY * LANES];
      for (std::size_t i = 0; i < count;)
        i += count - i <= FEW * LANES ? rank<FEW>(i, ranks) : rank<MANY>(i, ranks);
      Neighbour sorted[MOST_SITES + WIDTH];
      std::uint8_t taken[MOST_SITES + WIDTH];  // places of sites equally far away
      std::memset(taken, 0, count);
      for (std::size_t i = 0; i < count; ++i) {
        const auto rank = static_cast<std::size_t>(ranks[i]);
        sorted[rank + taken[rank]++] = Neighbour(distance[i], index[i]);
      }
      if (!std::is_sorted(sorted, sorted + count)) std::sort(sorted, sorted + count);
      const std::size_t found = std::min(count, nearest.size());
      std::copy_n(sorted, found, nearest.begin());
      return found;
    }
  };

  /// Replaces the nodes by those of their children that are near; by none when these are too many.
  [[gnu::always_inline]] void descend(std::size_t level) {
    std::uint32_t children[MOST_NODES];
    std::size_t count = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      if (count > MOST_NODES - WIDTH) {
        count = 0;
        complete_ = false;
        break;
      }
      float distance[WIDTH];
      Lanes low[3], high[3];
      load(search_->levels_[level][nodes_[i]], low, high);
      measure(low, high, low_, high_, distance);
      for (std::uint32_t j = 0; j < WIDTH; ++j) {
        children[count] = nodes_[i] * WIDTH + j;
        count += static_cast<std::size_t>(distance[j] <= reach_squared_);
      }
    }
    count_ = count;
    for (std::size_t i = 0; i < count; ++i) nodes_[i] = children[i];
  }

  /// Keeps the blocks' boxes side by side.
  [[gnu::always_inline]] void take_boxes() {
    for (std::size_t i = 0; i < count_; ++i) {
      const Boxes& boxes = search_->levels_[0][nodes_[i] / WIDTH];
      Boxes& to = boxes_[i / WIDTH];
      for (int axis = 0; axis < 3; ++axis) {
        to.low[axis][i % WIDTH] = boxes.low[axis][nodes_[i] % WIDTH];
        to.high[axis][i % WIDTH] = boxes.high[axis][nodes_[i] % WIDTH];
      }
    }
    for (std::size_t i = count_; i % WIDTH != 0; ++i)
      for (int axis = 0; axis < 3; ++axis)
        boxes_[i / WIDTH].low[axis][i % WIDTH] = boxes_[i / WIDTH].high[axis][i % WIDTH] = INFINITE;
  }

  /// The blocks that are near one query.
  [[gnu::always_inline]] std::size_t choose_blocks(const glm::vec3& query, float reach_squared,
                                                   std::uint32_t* blocks) const {
    std::size_t count = 0;
    for (std::size_t i = 0; i < count_; i += WIDTH) {
      float distance[WIDTH];
      Lanes low[3], high[3];
      load(boxes_[i / WIDTH], low, high);
      measure(low, high, query, query, distance);
      for (std::uint32_t j = 0; j < WIDTH; ++j) {
        blocks[count] = nodes_[i + j];
        count += static_cast<std::size_t>(distance[j] <= reach_squared);
      }
    }
    return count;
  }

  [[gnu::always_inline]] static void load(const Boxes& boxes, Lanes* low, Lanes* high) {
    for (int axis = 0; axis < 3; ++axis)
      load_lanes(boxes.low[axis], low[axis]), load_lanes(boxes.high[axis], high[axis]);
  }

  /// Squared distances of boxes from a box; infinite for unused ones.
  [[gnu::always_inline]] static void measure(const Lanes* low, const Lanes* high, const glm::vec3& from,
                                             const glm::vec3& to, float* distance) {
    Lanes squared{};
    for (int axis = 0; axis < 3; ++axis) {
      const Lanes below = low[axis] - to[axis], above = from[axis] - high[axis];
      Lanes apart = below > above ? below : above;
      apart = apart > 0.0F ? apart : Lanes{};
      squared += apart * apart;
    }
    store_lanes(squared, distance);
  }

  const NeighbourSearch* search_;
  glm::vec3 low_, high_;
  float reach_squared_;
  std::uint32_t nodes_[MOST_NODES];
  Boxes boxes_[MOST_NODES / WIDTH];  // of the blocks
  std::size_t count_;
  bool complete_ = true;  // else there are too many
};

}  // namespace splatray
