/// What LASzip predicts differences of coordinates by.
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace splatray {

/// The middle of five numbers, of which each new one replaces the least and the greatest in turn (M. Isenburg, LASzip,
/// 2013, streaming median). Begins with zeros.
class StreamingMedian {
 public:
  [[nodiscard]] std::int32_t get() const { return sorted_[2]; }

  void add(std::int32_t value) {
    const std::size_t from = drops_greatest_ ? 0 : 1;
    drops_greatest_ = drops_greatest_ ? value < sorted_[2] : value <= sorted_[2];
    // Where the value belongs cannot be predicted, so there is no branch on it.
    const std::int32_t kept[] = {sorted_[from], sorted_[from + 1], sorted_[from + 2], sorted_[from + 3]};
    sorted_[0] = std::min(kept[0], value);
    for (std::size_t i = 1; i < 4; ++i) sorted_[i] = std::max(kept[i - 1], std::min(kept[i], value));
    sorted_[4] = std::max(kept[3], value);
  }

 private:
  std::int32_t sorted_[5] = {};
  bool drops_greatest_ = true;
};

}  // namespace splatray
