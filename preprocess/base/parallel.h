/// Parallel loops that report progress and can be stopped.
#pragma once
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/progress.h"

namespace splatray {

/// A stage of the build: its name and the callback that hears its progress.
struct Stage {
  const char* name;
  const Progress& progress;  ///< may be empty

  /// Reports the share done; throws Error (interrupted) when the receiver asks to stop.
  void report(double share) const {
    if (progress && !progress(name, share))
      throw Error(ExitCode::interrupted, "preprocessing was interrupted");
  }
};

/// Calls body(i) for every i in [0, count), in parallel, and reports in between, always from the calling
/// thread. `body` must write only what belongs to i, so that the result does not depend on the number of
/// threads. A task is at least `grain` calls.
template <typename Body>
void parallel_each(const Stage& stage, std::size_t count, const Body& body, std::size_t grain = 256) {
  const std::size_t slice = std::max<std::size_t>(count / 32 + 1, 128 * grain);
  for (std::size_t begin = 0; begin < count; begin += slice) {
    stage.report(static_cast<double>(begin) / static_cast<double>(count));
    const std::size_t end = std::min(begin + slice, count);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(begin, end, grain), [&](const auto& range) {
      for (std::size_t i = range.begin(); i < range.end(); ++i) body(i);
    });
  }
  stage.report(1.0);
}

/// The numbers i < count that test(i) is true of, ascending. It is called twice for each, in parallel.
template <typename Test>
[[nodiscard]] std::vector<std::uint32_t> numbers_where(std::size_t count, const Test& test) {
  constexpr std::size_t CHUNK = std::size_t{1} << 14;
  std::vector<std::size_t> found(count / CHUNK + 2);  // in the chunks before
  const auto each_chunk = [&](const auto& body) {
    tbb::parallel_for(std::size_t{0}, found.size() - 1, [&](std::size_t chunk) {
      const std::size_t end = std::min((chunk + 1) * CHUNK, count);
      for (std::size_t i = chunk * CHUNK; i < end; ++i) body(chunk, i);
    });
  };
  each_chunk([&](std::size_t chunk, std::size_t i) { found[chunk + 1] += test(i) ? 1 : 0; });
  std::partial_sum(found.begin(), found.end(), found.begin());
  std::vector<std::uint32_t> numbers(found.back());
  each_chunk([&](std::size_t chunk, std::size_t i) {
    if (test(i)) numbers[found[chunk]++] = static_cast<std::uint32_t>(i);
  });
  return numbers;
}

/// values[order[0]], values[order[1]] and so on; nothing where there are no values.
template <typename Value>
[[nodiscard]] std::vector<Value> gather(const std::vector<Value>& values,
                                        const std::vector<std::uint32_t>& order) {
  std::vector<Value> gathered(values.empty() ? 0 : order.size());
  tbb::parallel_for(std::size_t{0}, gathered.size(), [&](std::size_t i) { gathered[i] = values[order[i]]; });
  return gathered;
}

}  // namespace splatray
