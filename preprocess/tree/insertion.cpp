#include "preprocess/tree/insertion.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <numeric>
#include <utility>

#include "engine/base/memory.h"
#include "preprocess/tree/listed_disc.h"

namespace splatray {
namespace {

constexpr std::size_t SPLATS_PER_TASK = 4096;     // splats whose leaves are listed together
constexpr std::uint32_t LAST_LEAF = 0x80000000U;  // of a splat; above all leaf indices

/// Lists every leaf of the tree that a disc comes near. Discs come in Z-order: most walks begin near where the one before
/// branched.
class LeafWalk {
 public:
  LeafWalk(const Octree& tree, std::vector<std::uint32_t>& leaves) : tree_(tree), leaves_(leaves) {}

  void walk(const ListedDisc& listed) {
    const Disc& disc = listed.disc;
    disc_ = &listed;
    const glm::dvec3 center(disc.x.center, disc.y.center, disc.z.center);
    const glm::dvec3 half_box(disc.x.half_box, disc.y.half_box, disc.z.half_box);
    low_ = glm::floor(center - half_box) - (LIST_INFLATION + 1.0);
    high_ = glm::ceil(center + half_box) + (LIST_INFLATION + 1.0);
    while (path_size_ > 1 && !holds_box(path_[path_size_ - 1])) --path_size_;
    descend(path_[path_size_ - 1], /*on_path=*/true);
  }

 private:
  struct Cell {
    std::uint32_t node;
    glm::uvec3 low;
    std::uint32_t size;
  };

  [[nodiscard]] bool holds_box(const Cell& cell) const {
    return glm::all(glm::greaterThanEqual(low_, cell.low)) &&
           glm::all(glm::lessThan(high_, cell.low + cell.size));
  }

  /// `on_path`: the cell is the last of path_ and holds the whole box.
  void descend(Cell cell, bool on_path) {
    while (true) {
      const std::uint32_t word = tree_.node_pool[cell.node];
      const std::uint32_t address = word & NODE_ADDRESS_MASK;
      if (word >> NODE_TAG_SHIFT != NODE_INNER) {
        leaves_.push_back(address);
        return;
      }
      const std::uint32_t half = cell.size / 2;
      const glm::uvec3 middle = cell.low + half;
      const glm::uvec3 first{low_.x >= middle.x, low_.y >= middle.y, low_.z >= middle.z};
      const glm::uvec3 last{high_.x >= middle.x, high_.y >= middle.y, high_.z >= middle.z};
      if (first != last) return branch({address, cell.low, half}, first, last);
      cell = {address + first.x + 2 * first.y + 4 * first.z, cell.low + first * half, half};
      if (on_path) path_[path_size_++] = cell;  // the box lies in one child
    }
  }

  /// `child`: the first one.
  void branch(const Cell& child, const glm::uvec3& first, const glm::uvec3& last) {
    for (std::uint32_t z = first.z; z <= last.z; ++z) {
      for (std::uint32_t y = first.y; y <= last.y; ++y) {
        for (std::uint32_t x = first.x; x <= last.x; ++x) {
          const glm::uvec3 low = child.low + glm::uvec3(x, y, z) * child.size;
          if (!disc_->is_in(low, child.size)) continue;
          descend({child.node + x + 2 * y + 4 * z, low, child.size}, /*on_path=*/false);
        }
      }
    }
  }

  const Octree& tree_;
  const ListedDisc* disc_ = nullptr;
  std::vector<std::uint32_t>& leaves_;
  glm::uvec3 low_{0};  // lattice box around everything the disc may meet
  glm::uvec3 high_{0};
  std::array<Cell, MAX_DEPTH + 1> path_{{{0, glm::uvec3(0), 1U << LATTICE_BITS}}};  // from the root on
  std::size_t path_size_ = 1;
};

/// The leaves of SPLATS_PER_TASK consecutive splats, splat by splat; the last one of each is marked LAST_LEAF.
std::vector<std::uint32_t> leaves_of_chunk(const Octree& tree, const SplatList& splats, std::size_t chunk) {
  const std::size_t end = std::min((chunk + 1) * SPLATS_PER_TASK, splats.size());
  std::vector<std::uint32_t> leaves;
  leaves.reserve(4 * SPLATS_PER_TASK);
  LeafWalk walk(tree, leaves);
  for (std::size_t i = chunk * SPLATS_PER_TASK; i < end; ++i) {
    walk.walk(ListedDisc(splats, i));
    leaves.back() |= LAST_LEAF;
  }
  leaves.shrink_to_fit();
  return leaves;
}

/// Adds up references; throws when there are more than can be addressed or anyone wants.
class ReferenceCount {
 public:
  explicit ReferenceCount(std::size_t splats) : most_(std::max(MOST_FREE, MOST_EACH * splats)) {}

  void add(std::uint64_t count) {
    const std::uint64_t total = total_ += count;
    if (total > std::numeric_limits<std::uint32_t>::max()) {
      throw Error(
          ExitCode::failed,
          "the leaves would list more than 2^32 - 1 splats, which cannot be addressed; use smaller radii or "
          "fewer points");
    }
    if (total > most_) {
      throw Error(ExitCode::usage, "the leaves would list each splat more than " + std::to_string(MOST_EACH) +
                                       " times, as discs reach far beyond their neighbours; use a smaller "
                                       "--radius-scale or smaller radii");
    }
  }

 private:
  /// Discs that meet their neighbours are listed 2 to 5 times, of ten times their radius 37 times; 100 times takes as long to
  /// trace as it takes memory.
  static constexpr std::uint64_t MOST_EACH = 100;
  static constexpr std::uint64_t MOST_FREE = std::uint64_t{1} << 24U;  ///< 64 MiB, which any scene may have

  const std::uint64_t most_;
  std::atomic<std::uint64_t> total_ = 0;
};

}  // namespace

std::vector<std::uint32_t> leaves_met(const Octree& tree, const SplatList& splats, std::size_t begin,
                                      std::size_t end) {
  std::vector<std::uint32_t> leaves;
  LeafWalk walk(tree, leaves);
  for (std::size_t i = begin; i < end; ++i) walk.walk(ListedDisc(splats, i));
  return leaves;
}

LeafLists insert_centres(const Octree& tree, const SplatList& splats) {
  LeafLists lists;
  lists.begin.reserve(tree.leaves.size() + 1);
  for (const Leaf& leaf : tree.leaves) lists.begin.push_back(leaf.begin);
  lists.begin.push_back(static_cast<std::uint32_t>(splats.size()));
  lists.splat.resize(splats.size());
  std::iota(lists.splat.begin(), lists.splat.end(), 0U);
  return lists;
}

LeafLists insert_overlaps(const Octree& tree, const SplatList& splats, const Stage& stage) {
  const std::size_t leaves = tree.leaves.size();
  std::vector<std::vector<std::uint32_t>> met((splats.size() + SPLATS_PER_TASK - 1) / SPLATS_PER_TASK);
  LeafLists lists;
  lists.begin.assign(leaves + 1, 0);
  ReferenceCount total(splats.size());
  const auto walk = [&](std::size_t chunk) {
    met[chunk] = leaves_of_chunk(tree, splats, chunk);
    total.add(met[chunk].size());
    for (const std::uint32_t leaf : met[chunk])
      std::atomic_ref(lists.begin[(leaf & ~LAST_LEAF) + 1]).fetch_add(1, std::memory_order_relaxed);
  };
  parallel_each(stage, met.size(), walk, /*grain=*/1);
  std::partial_sum(lists.begin.begin(), lists.begin.end(), lists.begin.begin());
  require_memory((std::uint64_t{lists.begin.back()} + leaves) * sizeof(std::uint32_t),
                 "the stage '" + std::string(stage.name) + "' of the build");
  lists.splat.resize(lists.begin.back());
  std::vector<std::uint32_t> place(lists.begin.begin(), lists.begin.end() - 1);
  tbb::parallel_for(std::size_t{0}, met.size(), [&](std::size_t chunk) {
    auto splat = static_cast<std::uint32_t>(chunk * SPLATS_PER_TASK);
    for (const std::uint32_t leaf : std::exchange(met[chunk], {})) {
      lists.splat[std::atomic_ref(place[leaf & ~LAST_LEAF]).fetch_add(1, std::memory_order_relaxed)] = splat;
      if ((leaf & LAST_LEAF) != 0) ++splat;
    }
  });
  parallel_each(stage, leaves, [&](std::size_t leaf) {
    std::sort(lists.splat.begin() + lists.begin[leaf], lists.splat.begin() + lists.begin[leaf + 1]);
  });
  return lists;
}

}  // namespace splatray
