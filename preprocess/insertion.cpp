#include "preprocess/insertion.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>

namespace splatray {
namespace {

/// Calls visit(leaf index) for every leaf of the tree that a disc may meet.
template <typename Visit>
class LeafWalk {
 public:
  LeafWalk(const Octree& tree, const Disc& disc, const Visit& visit)
      : tree_(tree),
        disc_(disc),
        visit_(visit),
        low_(glm::floor(disc.center - disc.half_box) - (LIST_INFLATION + 1.0)),
        high_(glm::ceil(disc.center + disc.half_box) + (LIST_INFLATION + 1.0)) {}

  void walk() { descend(0, glm::uvec3(0), 1U << LATTICE_BITS); }

 private:
  void descend(std::uint32_t node, glm::uvec3 cell_min, std::uint32_t cell_size) {
    const std::uint32_t word = tree_.node_pool[node];
    const std::uint32_t address = word & NODE_ADDRESS_MASK;
    if (word >> NODE_TAG_SHIFT != NODE_INNER) {
      visit_(address);
      return;
    }
    const std::uint32_t half = cell_size / 2;
    const glm::uvec3 middle = cell_min + half;
    const glm::uvec3 first{low_.x >= middle.x, low_.y >= middle.y, low_.z >= middle.z};
    const glm::uvec3 last{high_.x >= middle.x, high_.y >= middle.y, high_.z >= middle.z};
    if (first == last) {  // the whole box lies in one child
      descend(address + first.x + 2 * first.y + 4 * first.z, cell_min + first * half, half);
      return;
    }
    for (std::uint32_t z = first.z; z <= last.z; ++z) {
      for (std::uint32_t y = first.y; y <= last.y; ++y) {
        for (std::uint32_t x = first.x; x <= last.x; ++x) {
          const glm::uvec3 child_min = cell_min + glm::uvec3(x, y, z) * half;
          if (may_meet(disc_, child_min, half)) descend(address + x + 2 * y + 4 * z, child_min, half);
        }
      }
    }
  }

  const Octree& tree_;
  const Disc& disc_;
  const Visit& visit_;
  glm::uvec3 low_;  // lattice box around everything the disc may meet
  glm::uvec3 high_;
};

template <typename Visit>
void visit_leaves(const Octree& tree, const Disc& disc, const Visit& visit) {
  LeafWalk<Visit>(tree, disc, visit).walk();
}

/// Turns counts, at [i + 1], into begins; checks that the sum can be addressed.
void counts_to_begins(std::vector<std::uint32_t>& counts) {
  const std::uint64_t total = std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
  if (total > std::numeric_limits<std::uint32_t>::max()) {
    throw Error(ExitCode::failed,
                "the leaves would list " + std::to_string(total) +
                    " splats, at most 2^32 - 1 can be addressed; use smaller radii or fewer points");
  }
  std::partial_sum(counts.begin(), counts.end(), counts.begin());
}

}  // namespace

Disc::Disc(const uvec4& words) {
  const Splat splat = unpack_splat(words);
  center = splat.center;
  normal = splat.normal;
  radius_squared = splat.radius_squared;
  half_box = std::sqrt(radius_squared) * glm::sqrt(glm::max(1.0 - normal * normal, 0.0));
}

bool may_meet(const Disc& disc, glm::uvec3 cell_min, std::uint32_t cell_size) {
  const double half = 0.5 * cell_size + LIST_INFLATION;
  const glm::dvec3 offset = disc.center - (glm::dvec3(cell_min) + 0.5 * cell_size);
  const glm::dvec3 outside = glm::abs(offset) - half;
  if (glm::any(glm::greaterThan(outside, disc.half_box))) return false;
  const glm::dvec3 n = glm::abs(disc.normal);
  if (std::abs(glm::dot(disc.normal, offset)) > half * (n.x + n.y + n.z)) return false;
  const glm::dvec3 gap = glm::max(outside, 0.0);
  return glm::dot(gap, gap) <= disc.radius_squared;
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
  LeafLists lists;
  lists.begin.assign(leaves + 1, 0);
  parallel_each(stage, splats.size(), [&](std::size_t i) {
    visit_leaves(tree, Disc(splats.words[i]), [&](std::uint32_t leaf) {
      std::atomic_ref(lists.begin[leaf + 1]).fetch_add(1, std::memory_order_relaxed);
    });
  });
  counts_to_begins(lists.begin);
  lists.splat.resize(lists.begin.back());
  std::vector<std::uint32_t> place(lists.begin.begin(), lists.begin.end() - 1);
  parallel_each(stage, splats.size(), [&](std::size_t i) {
    visit_leaves(tree, Disc(splats.words[i]), [&](std::uint32_t leaf) {
      const std::uint32_t slot = std::atomic_ref(place[leaf]).fetch_add(1, std::memory_order_relaxed);
      lists.splat[slot] = static_cast<std::uint32_t>(i);
    });
  });
  parallel_each(stage, leaves, [&](std::size_t leaf) {
    std::sort(lists.splat.begin() + lists.begin[leaf], lists.splat.begin() + lists.begin[leaf + 1]);
  });
  return lists;
}

}  // namespace splatray
