/// Times of frames, and the work of their rays.
#pragma once
#include <vector>

#include "tests/bench/cases/loaded_case.h"

namespace splatray::testing {

/// Adds `speed` to the records of the case's runs, which are in the runs' order. Frames are timed in rounds, each with one
/// frame of every run, so that what else the machine does meets all alike: FEWEST_ROUNDS at least after a warm_up(), up to
/// MOST_ROUNDS while they are short, fewer (one at least) when they take longer than MOST_SECONDS. A frame's time is that of
/// its dispatches, on the device's clock where it has one.
void time_frames(LoadedCase& loaded, std::vector<Json>& records);

inline constexpr std::size_t FEWEST_ROUNDS = 9, MOST_ROUNDS = 101;
inline constexpr double ENOUGH_SECONDS = 0.3;  ///< of rounds beyond FEWEST_ROUNDS
inline constexpr double MOST_SECONDS = 25.0;

}  // namespace splatray::testing
