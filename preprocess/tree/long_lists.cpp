#include "preprocess/tree/long_lists.h"

#include <algorithm>
#include <array>
#include <span>

#include "engine/base/release.h"
#include "preprocess/base/morton.h"
#include "preprocess/tree/listed_disc.h"

namespace splatray {
namespace {

using List = std::vector<std::uint32_t>;

class Search {
 public:
  Search(const SplatList& splats, std::uint32_t leaf_size) : splats_(splats), leaf_size_(leaf_size) {}

  [[nodiscard]] bool is_long(const CellName& cell, std::span<const std::uint32_t> list,
                             std::size_t times = LONG_LIST) const {
    if (list.size() <= times * leaf_size_ || cell.level == MAX_DEPTH) return false;
    return !are_wide(
        splats_, list.size(), [&](std::size_t i) { return list[i]; }, size_of(cell));
  }

  /// Adds a cell, whose list is long, and what is long below it, depth first.
  void add(const CellName& cell, std::span<const std::uint32_t> list, std::vector<CellName>& found) const {
    found.push_back(cell);
    const std::uint32_t size = size_of(cell) / 2;
    const glm::uvec3 low = morton_point(cell.key);
    std::array<List, 8> lists;
    for (const std::uint32_t splat : list) {
      const ListedDisc disc(splats_, splat);
      for (std::uint32_t child = 0; child < 8; ++child)
        if (disc.is_in(child_cell({low, 2 * size}, child).low, size)) lists[child].push_back(splat);
    }
    for (std::uint32_t child = 0; child < 8; ++child) {
      const CellName its{morton_key(child_cell({low, 2 * size}, child).low), cell.level + 1};
      if (is_long(its, lists[child])) add(its, lists[child], found);
      release(lists[child]);
    }
  }

 private:
  static std::uint32_t size_of(const CellName& cell) { return 1U << (LATTICE_BITS - cell.level); }

  const SplatList& splats_;
  std::uint32_t leaf_size_;
};

}  // namespace

std::vector<CellName> find_long_lists(const Octree& tree, const LeafLists& lists, const SplatList& splats,
                                      std::uint32_t leaf_size) {
  const Search search(splats, leaf_size);
  const auto name = [&](std::size_t leaf) {
    return CellName{tree.leaves[leaf].key, tree.leaves[leaf].level};
  };
  const auto list = [&](std::size_t leaf) {
    return std::span(lists.splat).subspan(lists.begin[leaf], lists.begin[leaf + 1] - lists.begin[leaf]);
  };
  const auto leaves_above = [&](std::size_t times) {
    return numbers_where(tree.leaves.size(),
                         [&](std::size_t leaf) { return search.is_long(name(leaf), list(leaf), times); });
  };
  if (leaves_above(TOO_LONG_LIST).empty()) return {};
  const std::vector<std::uint32_t> leaves = leaves_above(LONG_LIST);
  std::vector<std::vector<CellName>> found(leaves.size());
  tbb::parallel_for(std::size_t{0}, leaves.size(),
                    [&](std::size_t n) { search.add(name(leaves[n]), list(leaves[n]), found[n]); });
  std::vector<CellName> all;
  for (const std::vector<CellName>& some : found) all.insert(all.end(), some.begin(), some.end());
  return all;
}

}  // namespace splatray
