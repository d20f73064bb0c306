/// One round of the property test: a random scene, random rays, three answers to each, one truth.
#pragma once
#include <cstdint>
#include <ostream>

#include "tests/gpu/shown_tracer.h"

namespace splatray::testing {

struct RoundCounts {
  std::uint64_t rounds = 0;
  /// Primary and secondary; each is asked of the GPU with two leaf sizes and of the twin.
  std::uint64_t rays = 0;
  std::uint64_t hits = 0;
  std::uint64_t ties = 0;     ///< answers that are right but for rounding (judge.h)
  std::uint64_t edge_on = 0;  ///< other clusters, where the ray lies nearly in the plane of a disc (judge.h)
  std::uint64_t exceptions = 0;  ///< wrong answers, and answers that differ between the leaf sizes
};

/// Runs the round of `seed`, adds to `counts` and describes exceptions on `out`; it ends at the fifth. `spoil` moves one splat of the
/// truth, to prove that exceptions are found.
void run_round(std::uint64_t seed, ShownTracer& tracer, RoundCounts& counts, std::ostream& out,
               bool spoil = false);

}  // namespace splatray::testing
