/// Values by their rank among others.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace splatray {

/// The value that `share` of the values, 0..1, lie below, to the nearest rank; changes their order. There must be one.
template <class Value>
[[nodiscard]] Value value_at(std::vector<Value>& values, double share) {
  const auto place = values.begin() + std::lround(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

}  // namespace splatray
