/// How many threads work at once.
#pragma once
#include <tbb/global_control.h>

#include <optional>

namespace splatray {

/// Limits the threads of all parallel loops while it lives; 0 = all cores. Of several the least counts.
class ThreadLimit {
 public:
  explicit ThreadLimit(unsigned threads) {
    if (threads > 0) control_.emplace(tbb::global_control::max_allowed_parallelism, threads);
  }

 private:
  std::optional<tbb::global_control> control_;
};

}  // namespace splatray
