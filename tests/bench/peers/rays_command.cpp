/// splatray-bench rays FOLDER -o RAYS.json [--quick] [--device D] [--case NAME]: splatray and Embree on the spheres
/// that splatray-bench prepare --scale made, one frame each in turn; one JSON array of records (race.h).
#include <chrono>

#include "app/cli/option_types.h"
#include "engine/base/error.h"
#include "engine/file/atomic_file.h"
#include "tests/bench/cases/scale_cases.h"
#include "tests/bench/commands.h"
#include "tests/bench/measure/measure_cases.h"
#include "tests/bench/measure/memory.h"
#include "tests/bench/measure/scale_rays.h"
#include "tests/bench/peers/peer_embree_clusters.h"
#include "tests/bench/peers/peer_embree_discs.h"
#include "tests/bench/peers/peer_racer.h"

namespace splatray::testing {
namespace {

/// Of a splat, at most: the scene twice, the discs in float32, a peer and what it takes to build it.
constexpr std::uint64_t BYTES_PER_SPLAT = 300;

template <class Make>
PeerMaker maker(const std::string& method, std::uint32_t blend, std::size_t group, bool secondary,
                const Make& make) {
  Settings settings;
  settings.blend = blend;
  return {blend, secondary, [=](const Course& course) {
            const auto begin = std::chrono::steady_clock::now();
            std::unique_ptr<Peer> peer = make(settings);
            const std::chrono::duration<double> build = std::chrono::steady_clock::now() - begin;
            return std::make_unique<PeerRacer>(std::move(peer), method, settings, group, build.count(),
                                               course);
          }};
}

std::vector<PeerMaker> peers_of(const Scene& scene) {
  const auto discs = std::make_shared<const Discs>(discs_of(scene));
  const auto built_in = [=](const Settings& settings) {
    return std::make_unique<EmbreeDiscs>(*discs, settings);
  };
  std::vector<PeerMaker> makers{maker("embree window", BLEND_WINDOW, 0, true, built_in),
                                maker("embree nearest", BLEND_NEAREST, 0, false, built_in)};
  for (const std::size_t group : {1, 8, 32})
    makers.push_back(maker(
        "embree user " + std::to_string(group), BLEND_WINDOW, group, group == 1,
        [=](const Settings& settings) { return std::make_unique<EmbreeClusters>(*discs, settings, group); }));
  return makers;
}

std::vector<Json> measure(const Device& device, const Case& one, const std::filesystem::path& prepared) {
  const std::string reason = reason_of_memory(BYTES_PER_SPLAT * one.runs.front().variant.points);
  if (!reason.empty()) throw Error(ExitCode::out_of_memory, reason);
  return measure_rays(device, one, prepared, peers_of);
}

}  // namespace

int bench_rays(int argc, char** argv) {
  OptionList list(
      "Races splatray and Embree on the spheres that splatray-bench prepare --scale made in FOLDER.",
      "splatray-bench rays");
  std::filesystem::path folder, output;
  std::string device, only;
  bool quick = false;
  add_path(list, "FOLDER", folder, "what splatray-bench prepare wrote");
  list.require("FOLDER");
  add_path(list, "-o,--output", output, "JSON file to write: one record for each run");
  list.require("--output");
  list.add_switch("--quick", quick, "only what splatray-bench prepare --scale --quick made");
  add_text(list, "--device", device,
           "number or part of a name, as splatray-render --list-devices shows them");
  add_text(list, "--case", only, "only this case");
  if (!list.parse(argc, argv)) return static_cast<int>(ExitCode::done);
  require_writable(output);
  const std::unique_ptr<Device> opened = open_device(device);
  measure_cases(named(scale_spheres(quick), only), folder, output,
                [&](const Case& one, const std::filesystem::path& prepared) {
                  return measure(*opened, one, prepared);
                });
  return static_cast<int>(ExitCode::done);
}

}  // namespace splatray::testing
