#include "tests/bench/measure/frames.h"

#include <chrono>

#include "tests/bench/measure/speed_record.h"
#include "tests/bench/measure/warm_up.h"

namespace splatray::testing {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Work per ray of all classes, and memory.
void add_work_and_memory(Json& speed, const LoadedVariant& variant, const RenderStats& counted) {
  const auto splats = static_cast<double>(variant.splats);
  add_work(speed, counted);
  speed["bytes_per_splat"] = bytes_per_splat(variant.tracer, variant.splats);
  speed["growth"] = static_cast<double>(variant.references) / splats - 1.0;
  if (variant.prepared.overlap > 0.0) speed["overlap"] = variant.prepared.overlap;
  speed["build_s"] = variant.prepared.build_s;
}

/// Counts with one sample, which has the rays of all in proportion.
RenderStats count_work(LoadedCase& loaded, const Run& run) {
  Settings settings = loaded.settings_of(run);
  settings.samples = 1;
  settings.counters = true;
  ShownTracer& tracer = loaded.variant_of(run).tracer;
  static_cast<void>(tracer.render(loaded.view(), settings));
  return tracer.stats();
}

double frame_ms(LoadedCase& loaded, const Run& run, std::uint32_t samples) {
  Settings settings = loaded.settings_of(run);
  settings.samples = samples;
  ShownTracer& tracer = loaded.variant_of(run).tracer;
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
  warm_up([&](std::uint32_t samples) { static_cast<void>(frame_ms(loaded, runs.front(), samples)); });
  const Clock::time_point start = Clock::now();
  for (std::size_t rounds = 0; go_on(rounds, seconds_since(start)); ++rounds)
    for (std::size_t i = 0; i < runs.size(); ++i)
      times[i].push_back(frame_ms(loaded, runs[i], runs[i].settings.samples));
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const RenderStats counted = count_work(loaded, runs[i]);
    Json& speed = records[i]["speed"];
    add_times(speed, times[i], static_cast<double>(counted.rays()) * runs[i].settings.samples);
    add_work_and_memory(speed, loaded.variant_of(runs[i]), counted);
  }
}

}  // namespace splatray::testing
