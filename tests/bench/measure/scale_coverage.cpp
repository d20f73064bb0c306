#include "tests/bench/measure/scale_coverage.h"

#include <cmath>
#include <numbers>

#include "engine/file/scene_file.h"
#include "tests/bench/cases/case_file.h"
#include "tests/bench/cases/random_rays.h"
#include "tests/bench/measure/speed_record.h"
#include "tests/bench/measure/warm_up.h"
#include "tests/bench/truth/pixel_rays.h"
#include "tests/gpu/shown_tracer.h"
#include "tests/trace/agreement.h"
#include "tests/trace/rays.h"

namespace splatray::testing {
namespace {

constexpr std::size_t ROUNDS = 25;
constexpr int HALVINGS = 14;

double coverage_of(ShownTracer& tracer, const View& view) {
  std::size_t hits = 0;
  const std::vector<AovPixel> pixels = tracer.trace_aov(view, {});
  for (const AovPixel& pixel : pixels) hits += pixel.object != NO_OBJECT ? 1 : 0;
  return static_cast<double>(hits) / static_cast<double>(pixels.size());
}

/// The view through a shorter or longer lens, of which `share` hits; more the longer it is.
View with_coverage(ShownTracer& tracer, View view, double share) {
  const double start = std::log(std::tan(view.camera.fov_y_deg * std::numbers::pi / 360.0));
  double low = start - 3.0, high = start + 3.0;
  for (int i = 0; i < HALVINGS; ++i) {
    const double middle = 0.5 * (low + high);
    view.camera.fov_y_deg = 2.0 * std::atan(std::exp(middle)) * 180.0 / std::numbers::pi;
    (coverage_of(tracer, view) > share ? low : high) = middle;
  }
  return view;
}

std::vector<Settings> settings_of_runs() {
  std::vector<Settings> list;
  for (const std::uint32_t blend : {BLEND_WINDOW, BLEND_NEAREST})
    for (const bool shadows : {false, true}) {
      Settings settings;
      settings.samples = 1;
      settings.blend = blend;
      settings.shadows = shadows;
      list.push_back(settings);
    }
  return list;
}

/// Centre rays of pixels spread evenly over the picture.
std::vector<RayQuery> compared_rays(const View& view, const RootTransform& root) {
  const PixelRays pixels(view);
  const std::uint64_t count = std::uint64_t{view.width} * view.height;
  std::vector<RayQuery> rays;
  for (std::size_t i = 0; i < COMPARED; ++i) {
    const std::uint64_t pixel = (i * count + count / 2) / COMPARED + i % view.width;
    rays.push_back(
        primary_query(root.to_root(pixels.eye_world()),
                      pixels.dir_world(static_cast<std::uint32_t>(pixel % view.width),
                                       static_cast<std::uint32_t>(pixel / view.width % view.height))));
  }
  return rays;
}

double mismatch_ppm(ShownTracer& tracer, const BruteForce& brute, const std::vector<RayQuery>& rays,
                    const Settings& settings) {
  const Agreement agreement =
      agreement_of(brute, all_nearest(brute, rays, settings), tracer.intersect(rays, settings));
  return 1e6 * static_cast<double>(agreement.exceptions()) / static_cast<double>(agreement.rays);
}

RenderStats frame(ShownTracer& tracer, const View& view, Settings settings, bool counters) {
  settings.counters = counters;
  static_cast<void>(tracer.render(view, settings));
  return tracer.stats();
}

/// Milliseconds of ROUNDS frames of each run.
std::vector<std::vector<double>> times_in_turn(ShownTracer& tracer, const View& view,
                                               const std::vector<Settings>& runs) {
  std::vector<std::vector<double>> times(runs.size());
  for (const Settings& run : runs) static_cast<void>(frame(tracer, view, run, false));
  warm_up([&](std::uint32_t samples) {
    Settings settings = runs.front();
    settings.samples = samples;
    static_cast<void>(frame(tracer, view, settings, false));
  });
  for (std::size_t round = 0; round < ROUNDS; ++round)
    for (std::size_t i = 0; i < runs.size(); ++i)
      times[i].push_back(frame(tracer, view, runs[i], false).trace_ms);
  return times;
}

}  // namespace

std::vector<Json> measure_coverage(const Device& device, const Case& one,
                                   const std::filesystem::path& folder) {
  const PreparedCase prepared = read_case(folder);
  const Scene scene = read_scene(folder / file_name(one.runs.front().variant));
  const BruteForce brute(scene);
  ShownTracer tracer(device);
  tracer.upload(scene);
  tracer.set_environment(read_environment_file(folder / "environment.bin"));
  const std::vector<Settings> runs = settings_of_runs();
  std::vector<Json> records;
  for (const double wanted : COVERAGES) {
    const View view = with_coverage(tracer, {prepared.camera, one.width, one.height}, wanted);
    const std::vector<RayQuery> rays = compared_rays(view, scene.root);
    const std::vector<std::vector<double>> times = times_in_turn(tracer, view, runs);
    const double reached = coverage_of(tracer, view);
    for (std::size_t i = 0; i < runs.size(); ++i) {
      Json record = start_record(one, {one.runs.front().variant, runs[i], ""}, scene.data_pool.size());
      add_device(record, device);
      const RenderStats counted = frame(tracer, view, runs[i], true);
      record["settings"]["coverage"] = wanted;
      record["coverage"] = reached;
      add_times(record["speed"], times[i], static_cast<double>(counted.rays()));
      record["speed"]["shadow_rays"] = counted.counters[COUNT_SHADOW];
      add_work(record["speed"], counted);
      record["speed"]["bytes_per_splat"] = bytes_per_splat(tracer, scene.data_pool.size());
      record["error"] = {{"truth", "brute force"},
                         {"mismatch_ppm", mismatch_ppm(tracer, brute, rays, runs[i])}};
      records.push_back(record);
    }
  }
  return records;
}

}  // namespace splatray::testing
