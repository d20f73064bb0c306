#include "tests/bench/frames.h"

#include <algorithm>
#include <chrono>

#include "tests/bench/statistics.h"

namespace splatray::testing {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Work per ray of all classes, and memory.
Json work_json(const LoadedVariant& variant, const RenderStats& counted) {
  const auto& count = counted.counters;
  const auto rays = static_cast<double>(counted.rays());
  const auto splats = static_cast<double>(variant.splats);
  Json json;
  json["tests_per_ray"] = static_cast<double>(count[COUNT_TESTS]) / rays;
  json["steps_per_ray"] = static_cast<double>(count[COUNT_NODE_STEPS]) / rays;
  json["leaves_per_ray"] = static_cast<double>(count[COUNT_LEAVES]) / rays;
  json["bytes_per_splat"] = static_cast<double>(total_bytes(variant.tracer.pool_bytes())) / splats;
  json["growth"] = static_cast<double>(variant.references) / splats - 1.0;
  if (variant.prepared.overlap > 0.0) json["overlap"] = variant.prepared.overlap;
  json["build_s"] = variant.prepared.build_s;
  json["rays"] = rays;
  return json;
}

/// Counts with one sample, which has the rays of all in proportion.
RenderStats count_work(LoadedCase& loaded, const Run& run) {
  Settings settings = loaded.settings_of(run);
  settings.samples = 1;
  settings.counters = true;
  Tracer& tracer = loaded.variant_of(run).tracer;
  static_cast<void>(tracer.render(loaded.view(), settings));
  return tracer.stats();
}

double frame_ms(LoadedCase& loaded, const Run& run, std::uint32_t samples) {
  Settings settings = loaded.settings_of(run);
  settings.samples = samples;
  Tracer& tracer = loaded.variant_of(run).tracer;
  static_cast<void>(tracer.render(loaded.view(), settings));
  return tracer.stats().trace_ms;
}

bool go_on(std::size_t rounds, double seconds) {
  if (rounds < FEWEST_ROUNDS) return rounds == 0 || seconds < MOST_SECONDS;
  return rounds < MOST_ROUNDS && seconds < ENOUGH_SECONDS;
}

}  // namespace

void time_frames(LoadedCase& loaded, std::vector<Json>& records) {
  const std::vector<Run>& runs = loaded.about().runs;
  std::vector<std::vector<double>> times(runs.size());
  for (const Run& run : runs) static_cast<void>(frame_ms(loaded, run, 1));
  const Clock::time_point start = Clock::now();
  for (std::size_t rounds = 0; go_on(rounds, seconds_since(start)); ++rounds)
    for (std::size_t i = 0; i < runs.size(); ++i)
      times[i].push_back(frame_ms(loaded, runs[i], runs[i].settings.samples));
  for (std::size_t i = 0; i < runs.size(); ++i) {
    Json work = work_json(loaded.variant_of(runs[i]), count_work(loaded, runs[i]));
    const double median = quantile(times[i], 0.5);
    Json& speed = records[i]["speed"];
    speed["frame_ms_median"] = median;
    speed["frame_ms_min"] = *std::min_element(times[i].begin(), times[i].end());
    speed["frames"] = times[i].size();
    speed["rays_per_s"] = work["rays"].get<double>() * runs[i].settings.samples / (median / 1000.0);
    work.erase("rays");
    speed.update(work);
  }
}

}  // namespace splatray::testing
