/// What a feature costs that is absent, there but out of view, and in view.
#pragma once
#include <filesystem>
#include <vector>

#include "engine/device/device.h"
#include "tests/bench/cases/cases.h"
#include "tests/bench/measure/record.h"

namespace splatray::testing {

/// Records (record.h) of each feature in each of its uses, on the splats of scale_sphere(), all of whose pixels hit: "feature",
/// and "use": absent, unused (in the scene, but not in view: it belongs to a cap on the sphere's far side, which is an
/// object of its own, or is a light from behind) or used. All are timed in rounds of one frame each. speed: frame_ms_median,
/// frame_ms_min, frames, rays_per_s (all classes), tests_per_ray, steps_per_ray, leaves_per_ray, rays. error.differs_ppm
/// of unused: pixels whose colour differs from those without the feature by more than 1 / 255.
[[nodiscard]] std::vector<Json> measure_features(const Device& device, const Case& one,
                                                 const std::filesystem::path& folder);

}  // namespace splatray::testing
