/// Which points hang together.
#pragma once
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace splatray {

/// Disjoint sets of numbers (Tarjan 1975), each named by its least member.
class Components {
 public:
  explicit Components(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0U); }

  /// The least member of the set of i.
  [[nodiscard]] std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  /// Joins the sets of i and j; false where they are one already.
  bool join(std::uint32_t i, std::uint32_t j) {
    i = find(i), j = find(j);
    if (i == j) return false;
    parent_[i < j ? j : i] = i < j ? i : j;
    return true;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace splatray
