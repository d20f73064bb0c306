/// What LASzip predicts differences of coordinates by.
#pragma once
#include <cstdint>

namespace splatray {

/// The middle of five numbers, of which each new one replaces the least and the greatest in turn (M. Isenburg, LASzip,
/// 2013, streaming median). Begins with zeros.
class StreamingMedian {
 public:
  [[nodiscard]] std::int32_t get() const { return sorted_[2]; }

  void add(std::int32_t value) {
    if (drops_greatest_) {
      drops_greatest_ = value < sorted_[2];
      int at = 4;
      for (; at > 0 && value < sorted_[at - 1]; --at) sorted_[at] = sorted_[at - 1];
      sorted_[at] = value;
    } else {
      drops_greatest_ = !(sorted_[2] < value);
      int at = 0;
      for (; at < 4 && sorted_[at + 1] < value; ++at) sorted_[at] = sorted_[at + 1];
      sorted_[at] = value;
    }
  }

 private:
  std::int32_t sorted_[5] = {};
  bool drops_greatest_ = true;
};

}  // namespace splatray
