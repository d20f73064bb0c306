/// One line of the report as JSON. A key that was not measured is absent.
/// Keys of the report of scale alone are described in race.h, scale_features.h and scale_coverage.h.
///   case, scene, method (blending, or a peer's name), varied (the knob not at its default, a key of settings; "" = none)
///   settings: splats, sampling (even | random | vertices), radius_rule, radius_scale, normal_fields, leaf_size (0: automatic),
///     insertion, probes, blend, kernel, kappa, side, samples, shadows, threads (of software devices), width, height
///   device: name, driver
///   commit, date (UTC, of the measurement)
///   speed: frame_ms_median, frame_ms_min, frames, rays_per_s (all classes), tests_per_ray, steps_per_ray, leaves_per_ray,
///     bytes_per_splat, growth (references / splats - 1), overlap (disc area / surface area), build_s
///   error: truth (analytic | mesh | brute force | 1024 samples) and the numbers of errors.h, probes.h and bounces.h, in ppm,
///     degrees, bounding-box diagonals, median radii (_r) and dB; holes_ppm and overhangs_ppm: {value, low, high, rays}
#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "tests/bench/cases/cases.h"
#include "tests/bench/cases/probes.h"
#include "tests/bench/truth/errors.h"

namespace splatray::testing {

using Json = nlohmann::ordered_json;

/// A run's record but for device, `speed`, `error` and settings.threads, on a scene of `splats` splats.
[[nodiscard]] Json start_record(const Case& one, const Run& run, std::uint64_t splats);

/// YYYY-MM-DD, UTC.
[[nodiscard]] std::string today();

/// Sets json[key] unless the value is NaN or infinite, which JSON cannot say (the PSNR of equal pictures).
void set_number(Json& json, const std::string& key, double value);

/// {value, low, high, rays}, ppm.
[[nodiscard]] Json share_json(const Share& share, std::uint64_t rays);

/// Adds what was measured to a record's `error`.
void add_errors(Json& error, const Errors& errors);
/// Likewise; its normals and holes, from more rays, replace a picture's.
void add_errors(Json& error, const ProbeErrors& errors);

}  // namespace splatray::testing
