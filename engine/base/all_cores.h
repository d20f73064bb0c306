/// Work shared among all cores.
#pragma once
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstring>
#include <exception>
#include <mutex>
#include <span>
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

/// Copies bytes to `target`, by all cores: where memory or file is new, most of the time goes into its pages, which they make at once.
inline void copy_on_all_cores(std::span<const std::byte> bytes, std::byte* target) {
  constexpr std::size_t SLICE = std::size_t{2} << 20U;  // a huge page
  on_all_cores((bytes.size() + SLICE - 1) / SLICE, [&](std::size_t slice) {
    const std::size_t at = slice * SLICE;
    std::memcpy(target + at, bytes.data() + at, std::min(SLICE, bytes.size() - at));
  });
}

}  // namespace splatray
