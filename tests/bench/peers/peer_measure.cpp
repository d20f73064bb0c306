#include "tests/bench/peers/peer_measure.h"

#include <chrono>
#include <memory>
#include <optional>

#include "engine/file/scene_file.h"
#include "preprocess/points.h"
#include "tests/bench/cases/case_file.h"
#include "tests/bench/measure/processor.h"
#include "tests/bench/measure/speed_record.h"
#include "tests/bench/peers/peer_embree_clusters.h"
#include "tests/bench/peers/peer_embree_discs.h"
#include "tests/bench/peers/peer_embree_mesh.h"
#include "tests/bench/peers/peer_frame.h"

namespace splatray::testing {
namespace {

constexpr std::size_t ROUNDS = 9;

/// What all peers of one scene file are built from and compared with.
struct Source {
  const Case& about;
  PreparedCase prepared;
  const PreparedVariant& variant;
  Scene scene;
  Discs discs;
  Discs flat;  ///< the discs without their normal fields
  FrameParams frame;
  View view;
};

/// A peer, and its record for each number of threads.
struct Entry {
  std::unique_ptr<Peer> peer;
  std::vector<Json> records;  ///< beside thread_counts()
  std::vector<std::vector<double>> times_ms;
};

/// One, and all.
std::vector<unsigned> thread_counts() {
  const unsigned all = processor_threads();
  return all > 1 ? std::vector<unsigned>{1, all} : std::vector<unsigned>{1};
}

/// Builds a peer with `make` and starts its records.
template <class Make>
Entry entry_of(const Source& source, const Run& run, const std::string& method, const Make& make) {
  const auto begin = std::chrono::steady_clock::now();
  Entry entry{make(), {}, {}};
  const std::chrono::duration<double> build = std::chrono::steady_clock::now() - begin;
  for (const unsigned threads : thread_counts()) {
    Json record = start_record(source.about, run, source.discs.size());
    record["method"] = method;
    record["settings"]["threads"] = threads;
    record["device"] = {{"name", processor_name()}, {"driver", "Embree " RTC_VERSION_STRING}};
    record["speed"]["build_s"] = build.count();
    record["speed"]["bytes_per_splat"] =
        static_cast<double>(entry.peer->bytes()) / static_cast<double>(source.discs.size());
    if (source.variant.overlap > 0.0) record["speed"]["overlap"] = source.variant.overlap;
    entry.records.push_back(record);
  }
  entry.times_ms.resize(entry.records.size());
  return entry;
}

Run with_blend(Run run, std::uint32_t blend) {
  run.settings.blend = blend;
  return run;
}

Entry discs_entry(const Source& source, const Run& run) {
  return entry_of(source, run, "embree " + blend_word(run.settings.blend), [&] {
    return std::make_unique<EmbreeDiscs>(run.variant.build.normal_fields ? source.discs : source.flat,
                                         run.settings);
  });
}

/// Discs without normal fields, as others trace them.
Entry flat_entry(const Source& source, Run run, std::uint32_t blend, std::uint32_t kernel) {
  run.settings.blend = blend;
  run.settings.kernel = kernel;
  run.variant.build.normal_fields = false;
  run.varied = "normal_fields";
  return discs_entry(source, run);
}

/// The peers of every number of splats.
void add_discs(const Source& source, const Run& run, std::vector<Entry>& entries) {
  for (const std::uint32_t blend : {BLEND_NEAREST, BLEND_WINDOW})
    entries.push_back(discs_entry(source, with_blend(run, blend)));
  entries.push_back(flat_entry(source, run, BLEND_WINDOW, KERNEL_GAUSSIAN));
}

void add_flat(const Source& source, const Run& run, std::vector<Entry>& entries) {
  for (const std::uint32_t blend : {BLEND_NEAREST, BLEND_WINDOW})
    entries.push_back(flat_entry(source, run, blend, run.settings.kernel));
}

void add_clusters(const Source& source, const Run& run, std::vector<Entry>& entries) {
  for (const std::uint32_t group : {1U, 8U}) {
    Run user = run;
    user.variant.build.leaf_size = group;
    user.varied = group == 1 ? "" : "leaf_size";
    entries.push_back(entry_of(source, user, "embree user", [&] {
      return std::make_unique<EmbreeClusters>(source.discs, user.settings, group);
    }));
  }
}

void add_mesh(const Source& source, const Run& run, const Mesh& mesh, std::vector<Entry>& entries) {
  entries.push_back(entry_of(source, run, "embree mesh",
                             [&] { return std::make_unique<EmbreeMesh>(mesh, source.scene.root); }));
}

/// In rounds, each with one frame of every peer, so that what else the machine does meets all alike.
void time_rounds(const Source& source, std::vector<Entry>& entries) {
  const std::vector<unsigned> threads = thread_counts();
  Image image;
  for (std::size_t round = 0; round < 1 + ROUNDS; ++round)
    for (Entry& entry : entries)
      for (std::size_t i = 0; i < threads.size(); ++i) {
        const double ms = trace_frame(*entry.peer, source.frame, threads[i], image);
        if (round > 0) entry.times_ms[i].push_back(ms);
      }
  for (Entry& entry : entries)
    for (std::size_t i = 0; i < threads.size(); ++i)
      add_times(entry.records[i]["speed"], entry.times_ms[i],
                double(source.frame.width) * source.frame.height);
}

void add_peer_errors(const Source& source, const Truth& truth, const std::optional<Probes>& probes,
                     Entry& entry) {
  Image image;
  trace_frame(*entry.peer, source.frame, thread_counts().back(), image);
  Json error{{"truth", source.prepared.truth}};
  add_errors(error, errors_of(image, truth, source.view, source.prepared.diagonal_world));
  if (probes) {
    const auto answer = [&](std::span<const RayQuery> rays) { return intersect(*entry.peer, rays); };
    add_errors(error, probes->measure(answer, source.variant.radius_median_world));
  }
  for (Json& record : entry.records) record["error"] = error;
}

std::optional<Mesh> mesh_of(const Case& one, const std::filesystem::path& data) {
  if (one.origin != Origin::mesh) return {};
  ReadOptions options;
  options.keep_meshes = true;
  return read_input({data / one.source}, options).objects.front().meshes.front();
}

/// Runs that differ in the number of splats only.
std::vector<Run> runs_of_sizes(const Case& one) {
  std::vector<Run> runs{one.runs.front()};
  for (const Run& run : one.runs)
    if (run.varied == "splats" && run.settings.blend == BLEND_WINDOW) runs.push_back(run);
  return runs;
}

}  // namespace

bool has_peers(const Case& one) { return one.measure == Measure::picture; }

std::vector<Json> measure_peers(const Case& one, const std::filesystem::path& folder,
                                const std::filesystem::path& data, bool quick) {
  const PreparedCase prepared = read_case(folder);
  const Truth truth = read_truth(folder / "truth.bin", one.width, one.height);
  const std::optional<Mesh> mesh = mesh_of(one, data);
  const View view{prepared.camera, one.width, one.height};
  std::vector<Json> records;
  for (const Run& run : runs_of_sizes(one)) {
    const std::string file = file_name(run.variant);
    Scene scene = read_scene(folder / file);
    Discs discs = discs_of(scene);
    Discs flat = discs;
    flat.slope.clear();
    const FrameParams frame = make_frame_params(scene, view, run.settings);
    const Source source{
        one,   prepared, prepared.variants.at(file), std::move(scene), std::move(discs), std::move(flat),
        frame, view};
    std::vector<Entry> entries;
    add_discs(source, run, entries);
    if (run.varied.empty() && mesh) add_mesh(source, run, *mesh, entries);
    if (run.varied.empty()) add_flat(source, run, entries);
    if (run.varied.empty() && !quick) add_clusters(source, run, entries);
    time_rounds(source, entries);
    std::optional<Probes> probes;
    if (one.shape) probes.emplace(*one.shape, source.scene.root, one.rays, 1);
    for (Entry& entry : entries) {
      add_peer_errors(source, truth, probes, entry);
      records.insert(records.end(), entry.records.begin(), entry.records.end());
    }
  }
  return records;
}

}  // namespace splatray::testing
