/// Nearest neighbours among the points of a cloud.
#pragma once
#include <bit>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <limits>
#include <span>
#include <vector>

#include "preprocess/base/parallel.h"
#include "preprocess/surface/cloud.h"

namespace splatray {

/// A neighbour's squared distance (cloud coordinates) and index in the cloud. Ordered by distance, then
/// index.
class Neighbour {
 public:
  Neighbour() = default;
  Neighbour(float distance_squared, std::uint32_t index)
      : key_(static_cast<std::uint64_t>(std::bit_cast<std::uint32_t>(distance_squared)) << 32 | index) {}
  [[nodiscard]] float distance_squared() const {
    return std::bit_cast<float>(static_cast<std::uint32_t>(key_ >> 32));
  }
  [[nodiscard]] std::uint32_t index() const { return static_cast<std::uint32_t>(key_); }
  friend auto operator<=>(const Neighbour&, const Neighbour&) = default;

 private:
  std::uint64_t key_ = 0;  // float bits of a number >= 0, then the index: orders like the pair
};

/// Which points of a cloud can be neighbours. Copies of a point would crowd out its true neighbours.
enum class Sites {
  positions,           ///< one point of each position
  oriented_positions,  ///< of each position up to 8 points of different normals
  oriented_surface     ///< the same, of the points that are of surfaces (Cloud::kind) alone
};

/// Bounding-box hierarchy over the sites in the order of a k-d tree: blocks of 8 consecutive sites, groups of 8
/// consecutive blocks and so on. Nothing is stored but the boxes. Answers are exact, also in ties, and
/// independent of threads.
class NeighbourSearch {
 public:
  /// The cloud must be in canonical order.
  NeighbourSearch(const Cloud& cloud, Sites sites);

  /// Whether every point is a site, as none is at the place of another: then all kinds of sites are the same.
  [[nodiscard]] bool has_all() const { return copies_.empty(); }
  /// Leaves the points that have a number in `number`, ascending like the points, which they have from then on; those with
  /// NO_CELL are no more. Every point must be a site.
  void keep(const std::vector<std::uint32_t>& number);

  /// The nearest sites at a distance > 0 from `query` (cloud coordinates), ascending; fills `nearest` from
  /// its start and returns how many there are: nearest.size(), fewer when there are fewer sites. Safe to call
  /// from many threads.
  std::size_t find(const glm::vec3& query, std::span<Neighbour> nearest) const;

  /// What is done with a point of the cloud and its nearest sites, which may be put into another order.
  using Visit = std::function<void(std::uint32_t point, std::span<Neighbour> nearest)>;

  /// Calls visit for every point of the cloud (or its surfaces, as the sites are) with what find() gives for `count` <= 32
  /// sites, from many threads and in any order. Faster than find(), as the sites of a block look through the same blocks around
  /// them.
  void find_all(std::size_t count, const Stage& stage, const Visit& visit) const;

  /// Most neighbours that find_each looks for.
  static constexpr std::size_t MOST_EACH = 96;

  /// What is looked for around a place, in cloud coordinates.
  struct Query {
    glm::vec3 place;
    /// Distance within which few more sites than asked for are expected; > 0, at most the limit.
    float guess_squared;
    float limit_squared;  ///< of the distance of what counts; may be infinite
  };
  using QueryOf = std::function<Query(std::uint32_t number)>;

  /// Calls visit for every number below `queries` with the nearest sites within its limit, at a distance > 0 from its place, at
  /// most `count` <= MOST_EACH, in an order that is the same on all machines; from many threads and in any order. Fastest where
  /// the places of most are near those of the numbers before.
  void find_each(std::size_t queries, const QueryOf& query_of, std::size_t count, const Stage& stage,
                 const Visit& visit) const;

 private:
  static constexpr std::uint32_t WIDTH = 8;
  static constexpr std::size_t MOST_NEAREST = 32;  // that find_all looks for
  struct Block {
    float x[WIDTH], y[WIDTH], z[WIDTH];  // unused places are at infinity
    std::uint32_t index[WIDTH];

    void measure(const glm::vec3& query, float* distance) const;  ///< WIDTH squared distances
    [[nodiscard]] bool has(std::uint32_t j) const { return x[j] < std::numeric_limits<float>::infinity(); }
  };
  struct Boxes {
    float low[3][WIDTH],
        high[3][WIDTH];  // of 8 consecutive nodes of the level below; unused ones are at infinity
  };
  struct Site {
    glm::vec3 coord;
    std::uint32_t index;
  };
  struct Nearest;
  class Ball;

  std::vector<Site> choose_sites(const Cloud& cloud, Sites sites);
  static void arrange(std::span<Site> sites, std::size_t capacity);
  void add_blocks(std::span<const Site> sites);
  void add_levels();
  void visit(std::size_t level, std::uint32_t node, const glm::vec3& query, Nearest& nearest) const;
  void visit_block(const Block& block, const glm::vec3& query, Nearest& nearest) const;
  float find_block(std::uint32_t block, float reach_squared, std::size_t count, const Visit& visit) const;
  std::size_t find_one(const Query& query, std::span<Neighbour> nearest) const;
  std::size_t find_some(std::span<const Query> queries, std::size_t first, std::size_t count, float& factor,
                        const Visit& visit) const;

  std::vector<Site> copies_;                // points that are no sites
  std::vector<Block> blocks_;               // places that are not used are anywhere in them
  std::vector<std::vector<Boxes>> levels_;  // levels_[0]: boxes of blocks; the last has one entry
};

}  // namespace splatray
