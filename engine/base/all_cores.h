/// Work shared among all cores.
#pragma once
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace splatray {

/// The threads that `asked` means: 0 = one a core.
[[nodiscard]] inline unsigned host_threads(unsigned asked) {
  return asked > 0 ? asked : std::max(std::thread::hardware_concurrency(), 1U);
}

/// Calls work(i) once for each 0 <= i < count, in any order, on as many threads as there are cores. What a call throws first is thrown
/// again when all threads have ended; calls that have not begun by then are left out.
template <class Work>
void on_all_cores(std::size_t count, const Work& work) {
  std::atomic<std::size_t> next{0};
  std::once_flag once;
  std::exception_ptr thrown;
  const auto take = [&] {
    try {
      for (std::size_t i = next++; i < count; i = next++) work(i);
    } catch (...) {
      std::call_once(once, [&] { thrown = std::current_exception(); });
      next = count;
    }
  };
  {
    std::vector<std::jthread> others;
    for (std::size_t i = 1; i < std::thread::hardware_concurrency() && i < count; ++i)
      others.emplace_back(take);
    take();
  }
  if (thrown) std::rethrow_exception(thrown);
}

}  // namespace splatray
