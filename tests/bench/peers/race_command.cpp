/// splatray-bench race SCENE.soct... -o MODELS.json [--rounds N] [--device D]: splatray and Embree on the same rays of scanned
/// models, one frame or list each in turn, Embree in all its settings. JSON: a list of {case, splats, coverage, rays (race_rays.h),
/// method, settings, commit, date, device, ms: [of each round], wall_ms: [likewise], unlike_ppm}. splatray's ms are those of its
/// dispatches, its wall_ms of the whole call with shading and read-back; Embree's are both the wall time of tracing. Embree has
/// traced each of its four samples through the pixel's centre. Settings of Embree that a first round shows far behind its best end there.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
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
#include "tests/bench/peers/race_rays.h"
#include "tests/gpu/shown_tracer.h"

namespace splatray::testing {
namespace {

constexpr std::uint32_t SIZE = 512;
constexpr std::size_t CLUSTER = 32;  ///< discs of a cluster: 8 and 16 were never better
constexpr double FAR_BEHIND = 1.5;   ///< times Embree's best of a round, which no noise makes of a best one
constexpr std::uint32_t AVX2_BITS = 256;

struct Times {
  double ms = 0.0, wall_ms = 0.0;
};

/// One way to trace rays.
struct Entry {
  Json record;
  bool peer = false;
  std::function<Times()> run;
  /// Of each ray: its depth, or 0 where only a hit is asked for; +inf on a miss.
  std::function<std::vector<float>()> answers;
};

/// What the entries of a model share.
struct Model {
  std::string name;
  Scene scene;
  View view{};
  Discs discs;
  FrameParams frame{};
  std::vector<RayQuery> primary;
  /// Of Embree's secondary rays off their surface, root units: a median radius, within which other discs of the sheet lie.
  float lift = 0.0F;
};

Settings settings_of(std::uint32_t blend, std::uint32_t samples = 1) {
  Settings settings;
  settings.samples = samples;
  settings.shadows = false;
  settings.blend = blend;
  return settings;
}

std::vector<float> depths_of(std::span<const RayHit> hits, bool any) {
  std::vector<float> depths;
  for (const RayHit& hit : hits) depths.push_back(any && hit.object != NO_OBJECT ? 0.0F : hit.t);
  return depths;
}

std::vector<float> depths_of(const std::vector<AovPixel>& pixels) {
  std::vector<float> depths;
  for (const AovPixel& pixel : pixels) depths.push_back(pixel.z);
  return depths;
}

/// `own` says what is unusual about the tracer.
Entry own_entry(const Device& device, ShownTracer& tracer, const Model& model, const RaceRays& rays,
                std::uint32_t blend, const Json& own = Json::object()) {
  Entry entry{{{"method", blend_word(blend)}, {"settings", own}}, false, {}, {}};
  entry.record["device"] = {{"name", device.info().name}, {"driver", device.info().driver}};
  const Settings settings = settings_of(rays.any ? BLEND_ANY : blend, std::max(rays.samples, 1U));
  entry.run = [&tracer, &model, &rays, settings] {
    if (rays.samples > 0) static_cast<void>(tracer.render(model.view, settings));
    if (rays.samples == 0) static_cast<void>(tracer.intersect(rays.list, settings));
    return Times{tracer.stats().trace_ms, tracer.stats().wall_ms};
  };
  entry.answers = [&tracer, &model, &rays, settings] {
    return rays.samples > 0 ? depths_of(tracer.trace_aov(model.view, settings))
                            : depths_of(tracer.intersect(rays.list, settings), rays.any);
  };
  return entry;
}

/// A peer with its settings.
struct NamedPeer {
  std::shared_ptr<Peer> peer;
  std::string method;
  Json settings;
};

/// The list as Embree is asked: secondary rays start off their surface.
std::vector<RayQuery> lifted(const RaceRays& rays, float lift) {
  std::vector<RayQuery> list = rays.list;
  for (RayQuery& ray : list) ray.origin += lift * ray.from_normal;
  return list;
}

Entry list_entry(Entry entry, const NamedPeer& named, const RaceRays& rays,
                 const std::shared_ptr<const std::vector<RayQuery>>& list) {
  const auto hits = std::make_shared<std::vector<RayHit>>(list->size());
  const auto blocked = std::make_shared<std::vector<std::uint8_t>>(list->size());
  entry.run = [=, peer = named.peer, any = rays.any, coherent = rays.coherent] {
    peer->expect_coherent(coherent);
    const double ms = any ? occlude_rays(*peer, *list, *blocked) : trace_rays(*peer, *list, *hits);
    return Times{ms, ms};
  };
  entry.answers = [=, run = entry.run, any = rays.any] {
    run();
    if (!any) return depths_of(*hits, false);
    std::vector<float> depths;
    for (const std::uint8_t one : *blocked) depths.push_back(one != 0 ? 0.0F : INFINITY);
    return depths;
  };
  return entry;
}

Entry frame_entry(Entry entry, const NamedPeer& named, const RaceRays& rays, const FrameParams& frame) {
  const auto image = std::make_shared<Image>();
  entry.run = [=, peer = named.peer, samples = rays.samples] {
    peer->expect_coherent(true);
    double ms = 0.0;
    for (std::uint32_t i = 0; i < samples; ++i) ms += trace_frame(*peer, frame, processor_threads(), *image);
    return Times{ms, ms};
  };
  entry.answers = [=, run = entry.run] {
    run();
    return depths_of(image->aov);
  };
  return entry;
}

std::vector<NamedPeer> peers_of(const Discs& discs, std::uint32_t blend) {
  std::vector<NamedPeer> peers;
  const Settings settings = settings_of(blend);
  for (const RTCBuildQuality quality : {RTC_BUILD_QUALITY_MEDIUM, RTC_BUILD_QUALITY_HIGH}) {
    const char* word = quality == RTC_BUILD_QUALITY_HIGH ? "high" : "medium";
    for (const unsigned width : {1U, 8U, 16U}) {
      peers.push_back({std::make_shared<EmbreeDiscs>(discs, settings, width, quality),
                       "embree discs " + blend_word(blend),
                       {{"width", width}, {"quality", word}}});
      peers.push_back({std::make_shared<EmbreeClusters>(discs, settings, CLUSTER, width, quality),
                       "embree clusters " + blend_word(blend),
                       {{"leaf_size", CLUSTER}, {"width", width}, {"quality", word}}});
    }
  }
  return peers;
}

void add_peers(const Model& model, const std::vector<NamedPeer>& peers, const RaceRays& rays,
               std::vector<Entry>& entries) {
  const auto list = std::make_shared<const std::vector<RayQuery>>(lifted(rays, model.lift));
  for (const NamedPeer& named : peers) {
    Entry entry{{{"method", named.method}, {"settings", named.settings}}, true, {}, {}};
    entry.record["device"] = {{"name", processor_name()}, {"driver", "Embree " RTC_VERSION_STRING}};
    entries.push_back(rays.samples > 0 ? frame_entry(entry, named, rays, model.frame)
                                       : list_entry(entry, named, rays, list));
  }
}

/// Share of rays, ppm, that are hit in one and missed in the other, or more than a tenth of a thousandth of the depth apart.
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

/// Drops the peers that a first round shows to be far behind the best of their method.
void drop_slow(std::vector<Entry>& entries) {
  std::map<std::string, double> best;
  std::vector<double> ms;
  for (Entry& entry : entries) {
    ms.push_back(entry.run().ms);
    const auto [at, fresh] = best.try_emplace(entry.record["method"].get<std::string>(), ms.back());
    if (!fresh) at->second = std::min(at->second, ms.back());
  }
  std::vector<Entry> kept;
  for (std::size_t i = 0; i < entries.size(); ++i)
    if (!entries[i].peer || ms[i] <= FAR_BEHIND * best[entries[i].record["method"].get<std::string>()])
      kept.push_back(std::move(entries[i]));
  entries = std::move(kept);
}

void write_records(const Model& model, const RaceRays& rays, std::vector<Entry>& entries, Json& records) {
  const std::vector<float> own = entries[0].answers();
  const auto hits = std::count_if(own.begin(), own.end(), [](float z) { return std::isfinite(z); });
  for (Entry& entry : entries) {
    Json record{{"case", model.name},
                {"splats", model.scene.data_pool.size()},
                {"rays", rays.kind},
                {"count", own.size()},
                {"coverage", static_cast<double>(hits) / static_cast<double>(own.size())},
                {"commit", COMMIT},
                {"date", today()}};
    record.update(entry.record);
    record["unlike_ppm"] = unlike_ppm(entry.answers(), own);
    records.push_back(record);
    std::printf("%s, %s, %s %s: %.1f ms, wall %.1f, %.0f ppm unlike\n", model.name.c_str(), rays.kind.c_str(),
                record["method"].get<std::string>().c_str(), record["settings"].dump().c_str(),
                quantile(record["ms"].get<std::vector<double>>(), 0.5),
                quantile(record["wall_ms"].get<std::vector<double>>(), 0.5),
                record["unlike_ppm"].get<double>());
    std::fflush(stdout);
  }
}

/// Runs all entries, whose first is that to which answers are compared.
void race(const Model& model, const RaceRays& rays, std::vector<Entry> entries, std::size_t rounds,
          Json& records) {
  drop_slow(entries);
  for (std::size_t round = 0; round < rounds; ++round)
    for (Entry& entry : entries) {
      const Times times = entry.run();
      entry.record["ms"].push_back(times.ms);
      entry.record["wall_ms"].push_back(times.wall_ms);
    }
  write_records(model, rays, entries, records);
}

Model model_of(const std::filesystem::path& path) {
  Model model;
  model.name = path.stem().string();
  model.scene = read_scene(path);
  model.view = {framing_camera(model.scene, 1.0), SIZE, SIZE};
  model.discs = discs_of(model.scene);
  model.frame = make_frame_params(model.scene, model.view, settings_of(BLEND_WINDOW));
  visit_bundles(model.frame, 1, [&](std::span<const RayQuery> rays, std::span<const std::size_t>) {
    model.primary.insert(model.primary.end(), rays.begin(), rays.end());
  });
  std::vector<double> radii;
  for (const Disc& disc : model.discs.list) radii.push_back(disc.radius);
  model.lift = static_cast<float>(quantile(radii, 0.5));
  return model;
}

/// All kinds of rays: by blended hits, and frames by nearest ones too. On the host frames also by one thread, and by shorter vectors.
void race_model(const Model& model, const Device& device, std::size_t rounds, Json& records) {
  ShownTracer tracer(device);
  tracer.upload(model.scene);
  ShownTracer alone(device, {.threads = 1}), narrow(device, {.vector_bits = AVX2_BITS});
  const bool host = device.info().api.empty();  // Vulkan's have one
  if (host) alone.upload(model.scene);
  if (host) narrow.upload(model.scene);
  const std::vector<RayHit> hits = tracer.intersect(model.primary, settings_of(BLEND_WINDOW));
  const std::vector<NamedPeer> window = peers_of(model.discs, BLEND_WINDOW);
  for (const RaceRays& rays : race_rays(model.scene, model.primary, hits)) {
    std::vector<Entry> entries{own_entry(device, tracer, model, rays, BLEND_WINDOW)};
    if (host && rays.kind == "frame") {
      entries.push_back(own_entry(device, alone, model, rays, BLEND_WINDOW, {{"threads", 1}}));
      entries.push_back(own_entry(device, narrow, model, rays, BLEND_WINDOW, {{"vector_bits", AVX2_BITS}}));
    }
    add_peers(model, window, rays, entries);
    race(model, rays, std::move(entries), rounds, records);
    if (rays.kind != "frame") continue;
    std::vector<Entry> nearest{own_entry(device, tracer, model, rays, BLEND_NEAREST)};
    add_peers(model, peers_of(model.discs, BLEND_NEAREST), rays, nearest);
    race(model, rays, std::move(nearest), rounds, records);
  }
}

}  // namespace

int bench_race(int argc, char** argv) {
  OptionList list("Races splatray and Embree, the latter in all its settings, on scenes.",
                  "splatray-bench race");
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
  for (const std::filesystem::path& path : scenes) race_model(model_of(path), *opened, rounds, records);
  write_text_file(records.dump() + '\n', output);
  return static_cast<int>(ExitCode::done);
}

}  // namespace splatray::testing
