/// splatray-bench race SCENE.soct... -o MODELS.json [--rounds N] [--device D]: splatray and Embree, each in all its settings,
/// one frame of primary rays of the same view each in turn, on scanned models. JSON: a list of {case, splats, coverage, method,
/// settings, commit, date, device, ms: [of each round], wall_ms: [likewise], unlike_ppm}. splatray's ms are those of its
/// dispatches, its wall_ms of the whole call with shading and read-back; Embree's are both the wall time of tracing.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>

#include "app/cli/option_types.h"
#include "app/library/commit.h"
#include "engine/base/error.h"
#include "engine/file/atomic_file.h"
#include "engine/file/scene_file.h"
#include "tests/bench/cases/statistics.h"
#include "tests/bench/commands.h"
#include "tests/bench/measure/processor.h"
#include "tests/bench/measure/record.h"
#include "tests/bench/peers/peer_embree_clusters.h"
#include "tests/bench/peers/peer_embree_discs.h"
#include "tests/bench/peers/peer_frame.h"
#include "tests/gpu/shown_tracer.h"

namespace splatray::testing {
namespace {

constexpr std::uint32_t SIZE = 512;
constexpr std::size_t CLUSTER = 32;  ///< discs of a cluster: 8 and 16 were never better

/// One way to trace the frame.
struct Entry {
  Json record;
  std::function<std::pair<double, double>()> run;  ///< ms, wall ms
  std::function<std::vector<float>()> depths;      ///< of the pixels; +inf on a miss
};

Settings settings_of(std::uint32_t blend) {
  Settings settings;
  settings.samples = 1;
  settings.shadows = false;
  settings.blend = blend;
  return settings;
}

Entry own_entry(const Device& device, ShownTracer& tracer, const View& view, std::uint32_t blend) {
  const Settings settings = settings_of(blend);
  Entry entry{{{"method", blend_word(blend)}, {"settings", Json::object()}}, {}, {}};
  entry.record["device"] = {{"name", device.info().name}, {"driver", device.info().driver}};
  entry.run = [&tracer, view, settings] {
    static_cast<void>(tracer.render(view, settings));
    return std::pair(tracer.stats().trace_ms, tracer.stats().wall_ms);
  };
  entry.depths = [&tracer, view, settings] {
    std::vector<float> depths;
    for (const AovPixel& pixel : tracer.trace_aov(view, settings)) depths.push_back(pixel.z);
    return depths;
  };
  return entry;
}

Entry peer_entry(std::shared_ptr<const Peer> peer, const FrameParams& frame, const std::string& method,
                 const Json& settings) {
  Entry entry{{{"method", method}, {"settings", settings}}, {}, {}};
  entry.record["device"] = {{"name", processor_name()}, {"driver", "Embree " RTC_VERSION_STRING}};
  const auto image = std::make_shared<Image>();
  entry.run = [peer, frame, image] {
    const double ms = trace_frame(*peer, frame, processor_threads(), *image);
    return std::pair(ms, ms);
  };
  entry.depths = [peer, frame, image] {
    trace_frame(*peer, frame, processor_threads(), *image);
    std::vector<float> depths;
    for (const AovPixel& pixel : image->aov) depths.push_back(pixel.z);
    return depths;
  };
  return entry;
}

void add_peers(const Discs& discs, const FrameParams& frame, std::vector<Entry>& entries) {
  for (const std::uint32_t blend : {BLEND_WINDOW, BLEND_NEAREST})
    for (const RTCBuildQuality quality : {RTC_BUILD_QUALITY_MEDIUM, RTC_BUILD_QUALITY_HIGH}) {
      const char* word = quality == RTC_BUILD_QUALITY_HIGH ? "high" : "medium";
      const Settings settings = settings_of(blend);
      for (const unsigned width : {1U, 8U, 16U}) {
        entries.push_back(peer_entry(std::make_shared<EmbreeDiscs>(discs, settings, width, quality), frame,
                                     "embree discs " + blend_word(blend),
                                     {{"width", width}, {"quality", word}}));
        entries.push_back(
            peer_entry(std::make_shared<EmbreeClusters>(discs, settings, CLUSTER, width, quality), frame,
                       "embree clusters " + blend_word(blend),
                       {{"leaf_size", CLUSTER}, {"width", width}, {"quality", word}}));
      }
    }
}

/// Share of pixels, ppm, that are hit in one and missed in the other, or more than a tenth of a thousandth of the depth apart.
double unlike_ppm(const std::vector<float>& depths, const std::vector<float>& reference) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < depths.size(); ++i) {
    const bool miss = std::isinf(depths[i]);
    count += miss != std::isinf(reference[i]) ||
                     (!miss && std::abs(depths[i] - reference[i]) > 1e-4F * reference[i])
                 ? 1
                 : 0;
  }
  return 1e6 * static_cast<double>(count) / static_cast<double>(depths.size());
}

void race(const std::string& name, const Device& device, const Scene& scene, std::size_t rounds,
          Json& records) {
  const View view{framing_camera(scene, 1.0), SIZE, SIZE};
  const Discs discs = discs_of(scene);
  const FrameParams frame = make_frame_params(scene, view, settings_of(BLEND_WINDOW));
  ShownTracer tracer(device);
  tracer.upload(scene);
  std::vector<Entry> entries;
  for (const std::uint32_t blend : {BLEND_WINDOW, BLEND_NEAREST})
    entries.push_back(own_entry(device, tracer, view, blend));
  add_peers(discs, frame, entries);
  for (std::size_t round = 0; round < 1 + rounds; ++round)
    for (Entry& entry : entries) {
      const auto [ms, wall_ms] = entry.run();
      if (round == 0) continue;
      entry.record["ms"].push_back(ms);
      entry.record["wall_ms"].push_back(wall_ms);
    }
  const std::vector<float> window = entries[0].depths(), nearest = entries[1].depths();
  const auto hits = std::count_if(window.begin(), window.end(), [](float z) { return std::isfinite(z); });
  for (Entry& entry : entries) {
    const bool blends = entry.record["method"].get<std::string>().ends_with("window");
    Json record{{"case", name},
                {"splats", scene.data_pool.size()},
                {"coverage", static_cast<double>(hits) / static_cast<double>(window.size())},
                {"commit", COMMIT},
                {"date", today()}};
    record.update(entry.record);
    record["unlike_ppm"] = unlike_ppm(entry.depths(), blends ? window : nearest);
    records.push_back(record);
    std::printf("%s, %s %s: %.1f ms, wall %.1f, %.0f ppm unlike\n", name.c_str(),
                record["method"].get<std::string>().c_str(), record["settings"].dump().c_str(),
                quantile(record["ms"].get<std::vector<double>>(), 0.5),
                quantile(record["wall_ms"].get<std::vector<double>>(), 0.5),
                record["unlike_ppm"].get<double>());
    std::fflush(stdout);
  }
}

}  // namespace

int bench_race(int argc, char** argv) {
  OptionList list("Races splatray and Embree, each in all its settings, on scenes.", "splatray-bench race");
  std::vector<std::filesystem::path> scenes;
  std::filesystem::path output;
  std::string device;
  std::size_t rounds = 9;
  list.add_paths("SCENE", scenes, "scene files (.soct)", "FILE...");
  list.require("SCENE");
  add_path(list, "-o,--output", output, "JSON file to write");
  list.require("--output");
  add_number(list, "--rounds", rounds, 1, 1e6, "timed frames of each, after one that is not; default 9");
  add_text(list, "--device", device,
           "number or part of a name, as splatray-render --list-devices shows them");
  if (!list.parse(argc, argv)) return static_cast<int>(ExitCode::done);
  require_writable(output);
  const std::unique_ptr<Device> opened = open_device(device);
  Json records = Json::array();
  for (const std::filesystem::path& path : scenes)
    race(path.stem().string(), *opened, read_scene(path), rounds, records);
  write_text_file(records.dump() + '\n', output);
  return static_cast<int>(ExitCode::done);
}

}  // namespace splatray::testing
