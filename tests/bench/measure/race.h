/// Ray tracers against each other on the same rays, one frame each in turn.
#pragma once
#include <vector>

#include "tests/bench/measure/racer.h"

namespace splatray::testing {

/// Records (record.h) of each racer and class of rays: "rays" is primary, shadow, mirror or random; "against" the first
/// other racer's method. speed.frame_ms_median is the time of the class's frame, cost_ms_median that of its rays: the median
/// over the rounds of the frame's time less that of the frame without them; rays_per_s is the class's rays over that
/// cost. error: primary and random rays by the exact sphere as for the other records, and unlike_ppm, the share of rays
/// that the first racer answers otherwise: hit for miss or more than UNLIKE_RADII in depth; shadow rays by
/// false_shadows_ppm; mirrored ones by wrong_bounces_ppm of further paths (bounces.h). `secondary`: shadow and mirror
/// too. Frames are run in RACE_ROUNDS rounds after a warm-up. Throws Error (failed) when a racer's unlike_ppm is above
/// MOST_UNLIKE_PPM: then the two do not trace the same splats.
[[nodiscard]] std::vector<Json> race(const Case& one, const Course& course, const std::vector<Racer*>& racers,
                                     bool secondary);

inline constexpr std::size_t RACE_ROUNDS = 9;
inline constexpr double UNLIKE_RADII = 0.1;  ///< median radii
inline constexpr double MOST_UNLIKE_PPM = 1000.0;

}  // namespace splatray::testing
