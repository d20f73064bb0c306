/// Answers that should be the same bits.
#pragma once
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <vector>

namespace splatray::testing {

/// How many of the elements do not have the same bits; all when the lengths differ.
template <typename Value>
[[nodiscard]] std::uint64_t different_bits(const std::vector<Value>& a, const std::vector<Value>& b) {
  if (a.size() != b.size()) return std::max(a.size(), b.size());
  std::uint64_t different = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    different += std::memcmp(&a[i], &b[i], sizeof(Value)) != 0 ? 1 : 0;
  return different;
}

}  // namespace splatray::testing
