/// Frames of which a given share of the pixels shows splats.
#pragma once
#include <array>
#include <filesystem>
#include <vector>

#include "engine/device/device.h"
#include "tests/bench/cases/cases.h"
#include "tests/bench/measure/record.h"

namespace splatray::testing {

/// Shares of the pixels that hit; the last fills the picture.
inline constexpr std::array<double, 2> COVERAGES = {0.3, 0.99};

/// Records (record.h) of the case's splats with the camera's lens changed until each of COVERAGES is reached, shaded without and
/// with shadow rays, blended by window and nearest, in rounds of one frame each. Settings' "coverage": of COVERAGES; the
/// record's: the share that was reached; speed: bytes_per_splat (all pools),
/// frame_ms_median, frame_ms_min, frames, rays_per_s (all classes), shadow_rays, tests_per_ray, steps_per_ray,
/// leaves_per_ray. error: mismatch_ppm of COMPARED rays through pixels' centres against brute force over all splats.
[[nodiscard]] std::vector<Json> measure_coverage(const Device& device, const Case& one,
                                                 const std::filesystem::path& folder);

inline constexpr std::size_t COMPARED = 1024;

}  // namespace splatray::testing
