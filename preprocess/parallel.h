/// Parallel loops that report progress and can be stopped.
#pragma once
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>

#include "engine/host/error.h"
#include "preprocess/build.h"

namespace splatray {

/// A stage of the build: its name and who is told about its progress.
struct Stage {
  const char* name;
  const BuildProgress& progress;  ///< may be empty

  /// Reports the share done; throws Error (interrupted) when the receiver asks to stop.
  void report(double share) const {
    if (progress && !progress(name, share))
      throw Error(ExitCode::interrupted, "preprocessing was interrupted");
  }
};

/// Calls body(i) for every i in [0, count), in parallel, and reports in between, always from the calling
/// thread. `body` must write only what belongs to i, so that the result does not depend on the number of
/// threads.
template <typename Body>
void parallel_each(const Stage& stage, std::size_t count, const Body& body) {
  const std::size_t slice = std::max<std::size_t>(count / 32 + 1, 1U << 15);
  for (std::size_t begin = 0; begin < count; begin += slice) {
    stage.report(static_cast<double>(begin) / static_cast<double>(count));
    const std::size_t end = std::min(begin + slice, count);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(begin, end, 256), [&](const auto& range) {
      for (std::size_t i = range.begin(); i < range.end(); ++i) body(i);
    });
  }
  stage.report(1.0);
}

}  // namespace splatray
