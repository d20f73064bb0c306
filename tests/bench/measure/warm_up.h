/// A device at the clocks that it works at.
#pragma once
#include <chrono>
#include <cstdint>

#include "engine/base/stopwatch.h"

namespace splatray::testing {

/// GPUs idle at a fraction of their clocks, and half a second of work raises them: an H100 idles at 345 MHz and works at 1980. A
/// millisecond of work at a time, with the host's between, does not.
inline constexpr double WARMING_MS = 1000.0;

/// Has the device do what is measured next: `work(samples)` with one sample, which builds its programs, then with twice as many each
/// time, so that the second half of the time is one piece of work.
template <class Work>
void warm_up(const Work& work) {
  work(std::uint32_t{1});
  const auto start = std::chrono::steady_clock::now();
  for (std::uint32_t samples = 1; milliseconds_since(start) < WARMING_MS; samples *= 2) work(samples);
}

}  // namespace splatray::testing
