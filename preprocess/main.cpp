/// splatray-preprocess: points or meshes in, a scene file out.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>

#include "engine/host/error.h"
#include "engine/host/scene_file.h"
#include "preprocess/build.h"

namespace {

using namespace splatray;

volatile std::sig_atomic_t interrupted = 0;

struct Options {
  std::vector<std::filesystem::path> inputs;
  std::filesystem::path output;
  std::filesystem::path stats_json;
  std::vector<std::filesystem::path> data_paths;
  BuildParams build;
  unsigned threads = 0;
};

/// An option whose value is one of a few names; an unknown name is an error that lists them.
template <typename Value>
CLI::Option* add_choice(CLI::App& app, const std::string& name, Value& value,
                        const std::map<std::string, Value>& choices, const std::string& initial,
                        const std::string& description) {
  std::vector<std::string> names;
  for (const auto& choice : choices) names.push_back(choice.first);
  return app
      .add_option_function<std::string>(
          name, [&value, choices](const std::string& text) { value = choices.at(text); }, description)
      ->check(CLI::IsMember(names))
      ->default_str(initial);
}

void add_file_options(CLI::App& app, Options& options) {
  app.add_option("INPUT", options.inputs, "files with points, meshes or a glTF scene")->required();
  app.add_option("-o,--output", options.output, "scene file to write (.soct)")->required();
  app.add_option("--data-path", options.data_paths,
                 "folder to search for models that a scene names; repeatable")
      ->allow_extra_args(false);
  app.add_option("--stats-json", options.stats_json, "file to write counts and times to");
}

void add_build_options(CLI::App& app, Options& options) {
  BuildParams& build = options.build;
  app.add_option("--leaf-size", build.leaf_size, "most splat centres in a leaf")
      ->capture_default_str()
      ->check(CLI::Range(1U, 1U << 20));
  add_choice<Insertion>(
      app, "--insertion", build.insertion,
      {{"overlap", Insertion::overlap}, {"probe", Insertion::probe}, {"centre", Insertion::centre}},
      "overlap", "which leaves list a splat");
  app.add_option("--probes", build.probes, "probe rays for each leaf, with --insertion probe")
      ->capture_default_str()
      ->check(CLI::Range(1U, 1U << 20));
  add_choice<RadiusRule>(app, "--radius-rule", build.radius_rule,
                         {{"coverage", RadiusRule::coverage}, {"knn", RadiusRule::knn}}, "coverage",
                         "radii of points that have none");
  app.add_option("--radius-scale", build.radius_scale, "factor on every radius")
      ->capture_default_str()
      ->check(CLI::Range(1e-6, 1e6));
  app.add_option("--samples", build.samples,
                 "points to sample on all meshes together; 0: their vertices where fine enough")
      ->capture_default_str();
  app.add_option("--seed", build.seed, "seed of samples and probe rays")->capture_default_str();
  app.add_option("--threads", options.threads, "threads to use; 0: all cores")
      ->capture_default_str()
      ->check(CLI::Range(0U, 1024U));
}

/// Shows the stage and its share on one line of a terminal; stops the build after SIGINT or SIGTERM.
bool show_progress(const char* stage, double share) {
  if (isatty(STDERR_FILENO) != 0) {
    std::fprintf(stderr, "\r%-10s %3d %%", stage, static_cast<int>(100.0 * share));
    if (share >= 1.0) std::fprintf(stderr, "\r%16s\r", "");
  }
  return interrupted == 0;
}

nlohmann::ordered_json stats_to_json(const BuildStats& stats) {
  return {{"points_read", stats.points_read},
          {"dropped_non_finite", stats.dropped_non_finite},
          {"dropped_duplicates", stats.dropped_duplicates},
          {"normals_given", stats.normals_given},
          {"normals_estimated", stats.normals_estimated},
          {"radii_given", stats.radii_given},
          {"radii_repaired", stats.radii_repaired},
          {"radii_isolated", stats.radii_isolated},
          {"splats", stats.splats},
          {"references", stats.references},
          {"nodes", stats.nodes},
          {"filled_leaves", stats.filled_leaves},
          {"depth", stats.depth},
          {"growth", stats.growth},
          {"growth_overlap", stats.growth_overlap},
          {"overlap", stats.overlap},
          {"radius_median_world", stats.radius_median_world},
          {"read_ms", stats.read_ms},
          {"normals_ms", stats.normals_ms},
          {"radii_ms", stats.radii_ms},
          {"octree_ms", stats.octree_ms},
          {"insertion_ms", stats.insertion_ms},
          {"total_ms", stats.total_ms}};
}

void write_stats(const BuildStats& stats, const std::filesystem::path& path) {
  std::ofstream file(path);
  file << stats_to_json(stats).dump(2) << '\n';
  if (!file.flush()) {
    throw Error(ExitCode::failed, path.string() + ": cannot be written, expected a path for the statistics");
  }
}

void print_repairs(const BuildStats& stats) {
  const auto line = [](std::uint64_t count, const char* what) {
    if (count > 0) std::printf("  %llu %s\n", static_cast<unsigned long long>(count), what);
  };
  line(stats.dropped_non_finite, "points dropped: position not finite");
  line(stats.dropped_duplicates, "points dropped: copies beyond the leaf size");
  line(stats.normals_estimated, "normals estimated");
  line(stats.radii_repaired, "given radii computed anew: zero, negative or not finite");
  line(stats.radii_isolated, "points without neighbours: radius relative to the scene");
}

void print_stats(const BuildStats& stats, const Options& options) {
  std::printf("%llu points -> %llu splats, median radius %.4g\n",
              static_cast<unsigned long long>(stats.points_read),
              static_cast<unsigned long long>(stats.splats), stats.radius_median_world);
  print_repairs(stats);
  std::printf("  %llu nodes, %llu filled leaves, depth %llu, %llu references: growth %.1f %%",
              static_cast<unsigned long long>(stats.nodes),
              static_cast<unsigned long long>(stats.filled_leaves),
              static_cast<unsigned long long>(stats.depth), static_cast<unsigned long long>(stats.references),
              100.0 * stats.growth);
  if (options.build.insertion == Insertion::probe)
    std::printf(" (overlap: %.1f %%)", 100.0 * stats.growth_overlap);
  if (stats.overlap > 0.0) std::printf(", disc area / surface area %.2f", stats.overlap);
  const auto bytes = std::filesystem::file_size(options.output);
  std::printf("\n  %s: %.1f MB, %.1f bytes per splat; read %.2f s, build %.2f s\n", options.output.c_str(),
              static_cast<double>(bytes) / 1e6,
              static_cast<double>(bytes) / static_cast<double>(stats.splats), stats.read_ms / 1e3,
              stats.total_ms / 1e3);
}

void preprocess(const Options& options) {
  BuildStats stats;
  const auto start = std::chrono::steady_clock::now();
  Input input = read_input(options.inputs, {.samples = options.build.samples,
                                            .seed = options.build.seed,
                                            .data_paths = options.data_paths,
                                            .keep_meshes = false});
  stats.read_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  for (const std::string& note : input.notes) std::fprintf(stderr, "note: %s\n", note.c_str());
  const Scene scene = build_scene(std::move(input), options.build, options.threads, stats, show_progress);
  write_scene(scene, options.output);
  if (!options.stats_json.empty()) write_stats(stats, options.stats_json);
  print_stats(stats, options);
}

int run(int argc, char** argv) {
  Options options;
  CLI::App app("Turns points or meshes into a scene of splats for splatray-render and splatray-view.",
               "splatray-preprocess");
  add_file_options(app, options);
  add_build_options(app, options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);
    throw Error(ExitCode::usage, std::string(error.what()) + " (--help lists the options)");
  }
  const auto stop = [](int) { interrupted = 1; };
  std::signal(SIGINT, stop);
  std::signal(SIGTERM, stop);
  preprocess(options);
  return static_cast<int>(ExitCode::done);
}

}  // namespace

int main(int argc, char** argv) { return run_main("splatray-preprocess", run, argc, argv); }
