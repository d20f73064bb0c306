/// Frees what arrays hold.
#pragma once
#include <vector>

namespace splatray {

/// Frees an array's memory: `values = {}` assigns a list of none, which keeps it.
template <typename Value>
void release(std::vector<Value>& values) {
  std::vector<Value>().swap(values);
}

}  // namespace splatray
