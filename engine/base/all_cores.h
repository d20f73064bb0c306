/// Work shared among all cores.
#pragma once
#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

namespace splatray {

/// Calls work(i) once for each 0 <= i < count, in any order, on as many threads as there are cores; `work` must not throw.
template <class Work>
void on_all_cores(std::size_t count, const Work& work) {
  std::atomic<std::size_t> next{0};
  const auto take = [&] {
    for (std::size_t i = next++; i < count; i = next++) work(i);
  };
  std::vector<std::jthread> others;
  for (std::size_t i = 1; i < std::thread::hardware_concurrency() && i < count; ++i)
    others.emplace_back(take);
  take();
}

}  // namespace splatray
