/// A device at the clocks that it works at.
#pragma once
#include <chrono>

#include "engine/base/stopwatch.h"

namespace splatray::testing {

/// GPUs idle at a fraction of their clocks, and half a second of work raises them: an H100 idles at 345 MHz and works at 1980.
inline constexpr double WARMING_MS = 500.0;

/// Has the device do what is measured next: once, which builds its programs, then for as long as its clocks need.
template <class Work>
void warm_up(const Work& work) {
  work();
  const auto start = std::chrono::steady_clock::now();
  do {
    work();
  } while (milliseconds_since(start) < WARMING_MS);
}

}  // namespace splatray::testing
