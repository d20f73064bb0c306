#include "tests/bench/measure/speed_record.h"

#include <algorithm>
#include <thread>

#include "tests/bench/cases/statistics.h"

namespace splatray::testing {

void add_device(Json& record, const Device& device) {
  const DeviceInfo& info = device.info();
  if (info.type == "CPU") record["settings"]["threads"] = std::thread::hardware_concurrency();
  record["device"] = {{"name", info.name}, {"driver", info.driver}};
}

void add_times(Json& speed, const std::vector<double>& times_ms, double rays) {
  const double median = quantile(times_ms, 0.5);
  speed["frame_ms_median"] = median;
  speed["frame_ms_min"] = *std::min_element(times_ms.begin(), times_ms.end());
  speed["frames"] = times_ms.size();
  speed["rays_per_s"] = rays / (median / 1000.0);
}

void add_work(Json& speed, const RenderStats& counted) {
  const auto& count = counted.counters;
  const auto rays = static_cast<double>(counted.rays());
  speed["tests_per_ray"] = static_cast<double>(count[COUNT_TESTS]) / rays;
  speed["steps_per_ray"] = static_cast<double>(count[COUNT_NODE_STEPS]) / rays;
  speed["leaves_per_ray"] = static_cast<double>(count[COUNT_LEAVES]) / rays;
}

double bytes_per_splat(const ShownTracer& tracer, std::size_t splats) {
  return static_cast<double>(total_bytes(tracer.pool_bytes())) / static_cast<double>(splats);
}

}  // namespace splatray::testing
