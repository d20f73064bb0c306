/// What records of frames on a device have in common (record.h).
#pragma once
#include <vector>

#include "engine/device/device.h"
#include "tests/bench/measure/record.h"
#include "tests/gpu/shown_tracer.h"

namespace splatray::testing {

/// Sets `device`, and settings.threads of a software device.
void add_device(Json& record, const Device& device);

/// Adds frame_ms_median, frame_ms_min, frames and rays_per_s: `rays` over the median.
void add_times(Json& speed, const std::vector<double>& times_ms, double rays);

/// Adds tests_per_ray, steps_per_ray and leaves_per_ray, of all classes, as counted.
void add_work(Json& speed, const RenderStats& counted);

/// What a scene of `splats` splats takes on the device, all pools, bytes a splat.
[[nodiscard]] double bytes_per_splat(const ShownTracer& tracer, std::size_t splats);

}  // namespace splatray::testing
