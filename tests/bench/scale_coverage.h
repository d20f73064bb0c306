/// Frames of which a given share of the pixels shows splats.
#pragma once
#include <filesystem>
#include <vector>

#include "engine/gpu/context.h"
#include "tests/bench/cases.h"
#include "tests/bench/record.h"

namespace splatray::testing {

/// The share of pixels that hit.
inline constexpr double COVERAGE = 0.3;

/// Records (record.h) of the case's splats with the camera's lens changed until COVERAGE is reached, shaded without and with
/// shadow rays, blended by window and nearest, in rounds of one frame each. "coverage": the share that was reached; speed:
/// frame_ms_median, frame_ms_min, frames, rays_per_s (all classes), shadow_rays, tests_per_ray, steps_per_ray,
/// leaves_per_ray. error: mismatch_ppm of COMPARED rays through pixels' centres against brute force over all splats.
[[nodiscard]] std::vector<Json> measure_coverage(const Context& context, const Case& one,
                                                 const std::filesystem::path& folder);

inline constexpr std::size_t COMPARED = 1024;

}  // namespace splatray::testing
