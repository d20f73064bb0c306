/// splatray-bench-bvh FOLDER [--device D] [--case NAME] [--rounds N]: the octree against a wide bounding volume
/// hierarchy (bvh.h), on the scenes that splatray-bench-prepare made; a table on stdout. Links the engine only.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <optional>
#include <string>

#include "engine/base/error.h"
#include "engine/file/scene_file.h"
#include "engine/gpu/tracer.h"
#include "tests/bench/bvh/bvh.h"
#include "tests/bench/cases/case_file.h"
#include "tests/bench/cases/cases.h"
#include "tests/bench/cases/statistics.h"
#include "tests/bench/measure/measuring_options.h"
#include "tests/trace/rays.h"

namespace splatray::testing {
namespace {

constexpr const char* USAGE =
    "splatray-bench-bvh FOLDER [--device NUMBER|NAME] [--case NAME] [--rounds N]\n"
    "Times the octree and a wide bounding volume hierarchy on the cases that splatray-bench-prepare made in\n"
    "FOLDER: primary rays of the case's picture, and random rays.\n"
    "  --device   number or part of a name, as splatray-render --list-devices shows them; default the best\n"
    "  --case     only this case\n"
    "  --rounds   frames of each, default 9\n";

constexpr const char* CASES[] = {"bunny 35k",     "dragon 100k",    "igea 134k",
                                 "Table I David", "sphere even 1M", "sphere random 1M"};
constexpr std::size_t RANDOM_RAYS = 1U << 18U;

struct Options {
  std::filesystem::path folder;
  std::string device;
  std::string only;
  std::size_t rounds = 9;
};

/// Nothing when help was asked for.
std::optional<Options> parse(const std::vector<std::string>& words) {
  Options options;
  const ValueOptions values{{"--device", [&](const std::string& value) { options.device = value; }},
                            {"--case", [&](const std::string& value) { options.only = value; }},
                            {"--rounds", [&](const std::string& value) {
                               options.rounds = std::max(1UL, std::strtoul(value.c_str(), nullptr, 10));
                             }}};
  if (!parse_words(words, options.folder, values, {}, "FOLDER")) return {};
  if (options.folder.empty())
    throw Error(ExitCode::usage, "found no FOLDER, expected one (--help lists the options)");
  return options;
}

/// Traces something once with these settings.
using Work = std::function<void(Tracer&, const Settings&)>;

struct Rival {
  const char* name;
  Tracer& tracer;
  std::vector<double> times{};  ///< of the dispatches, ms, by round
};

/// `of_octree` is the median over the rounds of this rival's time in the octree's. What is counted is per ray.
void print_row(const std::string& scene, const char* rays, const char* blend, Rival& rival, const Work& work,
               Settings settings, double of_octree) {
  settings.counters = true;
  work(rival.tracer, settings);
  const auto& count = rival.tracer.stats().counters;
  const auto all = static_cast<double>(rival.tracer.stats().rays());
  const double ms = quantile(rival.times, 0.5);
  std::printf("| %s | %s | %s | %s | %.1f | %.1f | %.2f | %.1f | %.1f | %.1f |\n", scene.c_str(), rays, blend,
              rival.name, ms, *std::min_element(rival.times.begin(), rival.times.end()), of_octree,
              static_cast<double>(count[COUNT_NODE_STEPS]) / all,
              static_cast<double>(count[COUNT_LEAVES]) / all, static_cast<double>(count[COUNT_TESTS]) / all);
}

/// One round after the other, each with one turn of both, so that what else the machine does meets them alike.
void compare(const std::string& scene, const char* rays, Rival octree, Rival bvh, const Work& work,
             std::size_t rounds) {
  for (const std::uint32_t blend : {BLEND_WINDOW, BLEND_NEAREST}) {
    Settings settings;
    settings.stages = settings.cull = false;  // the hierarchy has no programs for them
    settings.blend = blend;
    settings.shadows = false;
    settings.samples = 1;
    octree.times.clear();
    bvh.times.clear();
    for (std::size_t round = 0; round <= rounds; ++round) {
      for (Rival* rival : {&octree, &bvh}) {
        work(rival->tracer, settings);
        if (round > 0) rival->times.push_back(rival->tracer.stats().trace_ms);
      }
    }
    std::vector<double> ratios;
    for (std::size_t round = 0; round < rounds; ++round)
      ratios.push_back(bvh.times[round] / octree.times[round]);
    print_row(scene, rays, blend_word(blend).c_str(), octree, work, settings, 1.0);
    print_row(scene, rays, blend_word(blend).c_str(), bvh, work, settings, quantile(ratios, 0.5));
  }
}

void compare_case(const Context& context, const Case& one, const Options& options) {
  const std::filesystem::path folder = options.folder / folder_name(one);
  const PreparedCase prepared = read_case(folder);
  const std::string file = file_name(one.runs.front().variant);
  const Scene scene = read_scene(folder / file);
  Tracer octree(context);
  octree.upload(scene);
  octree.set_environment(read_environment_file(folder / "environment.bin"));
  BvhStats stats;
  Tracer bvh(context, {}, Arithmetic::automatic, bvh_code);
  bvh.upload(bvh_scene(scene, stats));
  bvh.set_environment(read_environment_file(folder / "environment.bin"));

  const View view{prepared.camera, one.width, one.height};
  compare(
      one.name, "primary", {"octree", octree}, {"BVH", bvh},
      [&](Tracer& tracer, const Settings& settings) { static_cast<void>(tracer.render(view, settings)); },
      options.rounds);
  const std::vector<RayQuery> rays = random_primary_rays(scene, RANDOM_RAYS, 1);
  compare(
      one.name, "random", {"octree", octree}, {"BVH", bvh},
      [&](Tracer& tracer, const Settings& settings) { static_cast<void>(tracer.intersect(rays, settings)); },
      options.rounds);
  const auto per_splat = [&](std::uint64_t bytes) {
    return static_cast<double>(bytes) / static_cast<double>(scene.data_pool.size());
  };
  std::printf(
      "%s: %llu splats; octree %.1f bytes a splat, built in %.2f s; BVH %.1f, built in %.2f s, "
      "%u nodes, depth %u\n",
      one.name.c_str(), static_cast<unsigned long long>(scene.data_pool.size()),
      per_splat(total_bytes(octree.pool_bytes())), prepared.variants.at(file).build_s,
      per_splat(total_bytes(bvh.pool_bytes()) - bvh.pool_bytes().top_table), stats.build_s, stats.nodes,
      stats.depth);
  std::fflush(stdout);
}

int run(int argc, char** argv) {
  const std::optional<Options> options = parse({argv + 1, argv + argc});
  if (!options) {
    std::fputs(USAGE, stdout);
    return static_cast<int>(ExitCode::done);
  }
  const Context context(options->device);
  std::printf("%s, %s\n", context.device_info().name.c_str(), context.device_info().driver.c_str());
  std::printf("| scene | rays | blend | structure | ms | least | of octree | nodes | lists | tests |\n");
  std::printf("| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n");
  for (const Case& one : cases(false)) {
    const bool listed = std::find(std::begin(CASES), std::end(CASES), one.name) != std::end(CASES);
    if (options->only.empty() ? listed : one.name == options->only) compare_case(context, one, *options);
  }
  return static_cast<int>(ExitCode::done);
}

}  // namespace
}  // namespace splatray::testing

int main(int argc, char** argv) {
  return splatray::run_main("splatray-bench-bvh", splatray::testing::run, argc, argv);
}
