#include "engine/cpu/run_groups.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <thread>
#include <vector>

#include "engine/base/all_cores.h"

namespace splatray {

void run_groups(Kernel kernel, const KernelWork& work, std::uint32_t count, unsigned threads,
                std::array<std::uint64_t, COUNTER_COUNT>& counts) {
  std::atomic<std::uint32_t> next = 0;
  std::mutex mutex;
  const auto run = [&] {
    Counts counted{};
    for (std::uint32_t group = next++; group < count; group = next++) kernel(work, group, counted);
    const std::lock_guard lock(mutex);
    for (std::size_t i = 0; i < counts.size(); ++i) counts[i] += counted[i];
  };
  threads = host_threads(threads);
  std::vector<std::jthread> others(std::min(threads, count) - (count > 0));
  for (std::jthread& other : others) other = std::jthread(run);
  run();
}

}  // namespace splatray
