/// Answers that should be the same bits.
#pragma once
#include <algorithm>
#include <cstdint>
#include <cstring>

namespace splatray::testing {

/// How many of the elements do not have the same bits; all when the lengths differ.
template <typename Values>
[[nodiscard]] std::uint64_t different_bits(const Values& a, const Values& b) {
  if (a.size() != b.size()) return std::max<std::uint64_t>(a.size(), b.size());
  std::uint64_t different = 0;
  for (std::size_t i = 0; i < a.size(); ++i) different += std::memcmp(&a[i], &b[i], sizeof a[i]) != 0 ? 1 : 0;
  return different;
}

}  // namespace splatray::testing
