/// splatray-bench exact -o EXACTNESS.json [--rays N] [--minutes M] [--points N] [--piece N] [--scene NAME] [--regions]
/// [--device D]: counts the answers that differ from brute force in float64, and adds them to the counts of the same commit, device
/// and scenes that the file holds, piece by piece, so that a run may be ended and taken up at any time. JSON: a list of {scene, splats, kind,
/// commit, date, device: {name, driver}, pieces} and the numbers of ExactCount.
#include <chrono>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <memory>

#include "app/cli/option_types.h"
#include "app/library/commit.h"
#include "engine/base/error.h"
#include "engine/file/atomic_file.h"
#include "tests/bench/commands.h"
#include "tests/bench/exact/exact_count.h"
#include "tests/bench/exact/exact_scenes.h"
#include "tests/bench/measure/record.h"
#include "tests/trace/scenes.h"

namespace splatray::testing {
namespace {

struct Options {
  std::filesystem::path output;
  std::string device, only;
  double minutes = 1e6;
  bool regions = false;
  std::uint64_t rays = 10'000'000, points = 1'000'000, piece = 20'000;
};

/// The records of the file, and those of this commit and device by scene and kind.
class Counts {
 public:
  Counts(std::filesystem::path file, const Device& device)
      : file_(std::move(file)), device_{{"name", device.info().name}, {"driver", device.info().driver}} {
    if (!std::filesystem::exists(file_)) return;
    std::ifstream stream(file_);
    records_ = Json::parse(stream, nullptr, false);
    if (!records_.is_array())
      throw Error(ExitCode::input_unreadable,
                  file_.string() + ": found no list of counts, expected one as JSON");
  }

  void add(const std::string& scene, std::uint64_t splats, const std::string& kind, const ExactCount& count) {
    Json& record = find(scene, splats, kind);
    const std::pair<const char*, std::uint64_t> numbers[] = {
        {"pieces", 1},
        {"rays", count.rays},
        {"hits", count.hits},
        {"hit_or_miss", count.hit_or_miss},
        {"first_splat", count.first_splat},
        {"ties", count.ties},
        {"members", count.members},
        {"normals", count.normals},
    };
    for (const auto& [name, number] : numbers) record[name] = record.value(name, std::uint64_t{0}) + number;
  }
  /// The largest of a scene's kinds.
  [[nodiscard]] std::uint64_t pieces(const std::string& scene) const {
    std::uint64_t most = 0;
    for (const Json& record : records_)
      if (is_ours(record) && record["scene"] == scene) most = std::max<std::uint64_t>(most, record["pieces"]);
    return most;
  }
  /// Rays of a kind over all scenes.
  [[nodiscard]] std::uint64_t rays(std::string_view kind) const {
    std::uint64_t sum = 0;
    for (const Json& record : records_)
      if (is_ours(record) && record["kind"] == kind) sum += record["rays"].get<std::uint64_t>();
    return sum;
  }
  void write() const { write_text_file(records_.dump(1) + '\n', file_); }

 private:
  [[nodiscard]] bool is_ours(const Json& record) const {
    return record["commit"] == COMMIT && record["device"] == device_;
  }
  Json& find(const std::string& scene, std::uint64_t splats, const std::string& kind) {
    for (Json& record : records_)
      if (is_ours(record) && record["scene"] == scene && record["splats"] == splats && record["kind"] == kind)
        return record;
    records_.push_back({{"scene", scene},
                        {"splats", splats},
                        {"kind", kind},
                        {"commit", COMMIT},
                        {"date", today()},
                        {"device", device_}});
    return records_.back();
  }

  std::filesystem::path file_;
  Json device_;
  Json records_ = Json::array();
};

/// Whether every kind has its rays.
bool is_done(const Counts& counts, std::uint64_t rays) {
  for (const char* kind : {"primary", "shadow", "mirrored", "refracted", "random"})
    if (counts.rays(kind) < rays) return false;
  return std::all_of(ADVERSARIAL.begin(), ADVERSARIAL.end(),
                     [&](std::string_view kind) { return counts.rays(kind) >= rays / 10; });
}

struct Loaded {
  std::string name;
  std::uint64_t number;
  std::unique_ptr<ExactScene> scene;
};

std::vector<Loaded> load_all(const Device& device, const Options& options) {
  std::vector<Loaded> list;
  std::uint64_t number = 0;
  for (const std::string& name : exact_scene_names()) {
    ++number;
    if (!options.only.empty() && name != options.only) continue;
    std::optional<Scene> scene = exact_scene(name, options.points, data_folder().value_or(""));
    std::printf("%s: %s\n", name.c_str(), scene ? "made" : "left out, SPLATRAY_DATA_DIR does not hold it");
    std::fflush(stdout);
    if (!scene) continue;
    list.push_back({name + (options.regions ? " in regions" : ""), number,
                    std::make_unique<ExactScene>(device, std::move(*scene), options.regions)});
  }
  return list;
}

/// A piece of one scene. Each scene and piece has a seed of its own.
void count_piece(const Loaded& loaded, std::size_t rays, Counts& counts) {
  const std::uint64_t seed = (loaded.number << 32U) + counts.pieces(loaded.name);
  ExactCount all;
  loaded.scene->count(rays, seed, [&](const std::string& kind, const ExactCount& count) {
    counts.add(loaded.name, loaded.scene->splats(), kind, count);
    all.add(count);
    if (count.different_hits() > 0)
      std::printf("%s, %s, seed %llu: %llu hits differ\n", loaded.name.c_str(), kind.c_str(),
                  static_cast<unsigned long long>(seed),
                  static_cast<unsigned long long>(count.different_hits()));
  });
  counts.write();
  std::printf("%s: %llu rays, %llu hits differ, %llu ties\n", loaded.name.c_str(),
              static_cast<unsigned long long>(all.rays),
              static_cast<unsigned long long>(all.different_hits()),
              static_cast<unsigned long long>(all.ties));
  std::fflush(stdout);
}

}  // namespace

int bench_exact(int argc, char** argv) {
  OptionList list(
      "Counts answers that differ from brute force in float64. Real models come from SPLATRAY_DATA_DIR.",
      "splatray-bench exact");
  Options options;
  add_path(list, "-o,--output", options.output, "JSON file of counts, added to when it is there");
  list.require("--output");
  add_number(list, "--rays", options.rays, 1, 1e12,
             "of each kind, over all scenes; of the adversarial kinds a tenth");
  add_number(list, "--minutes", options.minutes, 0, 1e6, "ends with the piece in which they have passed");
  add_number(list, "--points", options.points, 1, 1e9, "of each scene");
  add_number(list, "--piece", options.piece, 1, 1e9, "rays of a kind between two looks at the clock");
  add_text(list, "--scene", options.only, "only this scene");
  list.add_switch("--regions", options.regions, "rays meet what is in a region, another for each piece");
  add_text(list, "--device", options.device,
           "number or part of a name, as splatray-render --list-devices shows them");
  if (!list.parse(argc, argv)) return static_cast<int>(ExitCode::done);
  require_writable(options.output);
  const auto begin = std::chrono::steady_clock::now();
  const std::unique_ptr<Device> device = open_device(options.device);
  Counts counts(options.output, *device);
  const std::vector<Loaded> scenes = load_all(*device, options);
  for (std::size_t next = 0; !scenes.empty() && !is_done(counts, options.rays); ++next) {
    const std::chrono::duration<double, std::ratio<60>> passed = std::chrono::steady_clock::now() - begin;
    if (passed.count() >= options.minutes) break;
    count_piece(scenes[next % scenes.size()], options.piece, counts);
  }
  return static_cast<int>(ExitCode::done);
}

}  // namespace splatray::testing
