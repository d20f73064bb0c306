/// splatray-preprocess: points or meshes in, a scene file out.
#include <malloc.h>

#include <chrono>
#include <cstdio>

#include "app/cli/build_options.h"
#include "app/cli/option_types.h"
#include "engine/base/error.h"
#include "engine/base/interrupt.h"
#include "engine/base/memory.h"
#include "engine/base/progress.h"
#include "engine/file/atomic_file.h"
#include "engine/file/scene_file.h"
#include "preprocess/build.h"
#include "preprocess/build_report.h"
#include "preprocess/read/formats.h"

namespace {

using namespace splatray;

struct Options {
  BuildOptions build;
  std::filesystem::path output;
  std::filesystem::path stats_json;  ///< empty = none
};

/// False when help was asked for and printed.
bool parse(int argc, char** argv, Options& options) {
  OptionList list("Turns points or meshes into a scene of splats for splatray-render and splatray-view.",
                  "splatray-preprocess");
  list.add_paths("INPUT", options.build.inputs,
                 "files with points, meshes or a scene: " + format_extensions(), "FILE");
  list.require("INPUT");
  add_path(list, "-o,--output", options.output, "scene file to write (.soct)");
  list.require("--output");
  add_build_options(list, options.build, "--samples");
  add_number(list, "--seed", options.build.params.seed, 0, 4294967295.0,
             "seed of samples and probe rays; default 1");
  add_path(list, "--stats-json", options.stats_json, "file to write counts and times to");
  return list.parse(argc, argv);
}

/// A build takes and frees many large arrays: glibc's malloc keeps their memory instead of giving it back, as each page that the
/// kernel hands out anew costs microseconds.
void keep_freed_memory() {
  constexpr int GROWTH_BYTES = 64 << 20;
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, -1);  // never
  mallopt(M_TOP_PAD, GROWTH_BYTES);
}

Input read(const BuildOptions& options, BuildStats& stats, const Progress& progress) {
  const auto start = std::chrono::steady_clock::now();
  Input input = read_input(options.inputs, read_options(options, progress));
  stats.read_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  return input;
}

void print_notes(const std::vector<std::string>& notes) {
  for (const std::string& note : notes) std::fprintf(stderr, "splatray-preprocess: note: %s\n", note.c_str());
}

int run(int argc, char** argv) {
  Options options;
  if (!parse(argc, argv, options)) return static_cast<int>(ExitCode::done);
  require_writable(options.output);
  if (!options.stats_json.empty()) require_writable(options.stats_json);
  catch_interrupts();
  keep_freed_memory();

  ProgressLine line(/*quiet=*/false);
  const Progress progress = watching_memory([&](const char* stage, double share) {
    line.show(stage, share);
    return !interrupted();
  });
  BuildStats stats;
  Input input = read(options.build, stats, progress);
  line.clear();
  print_notes(input.notes);
  const Scene scene =
      build_scene(std::move(input), options.build.params, options.build.threads, stats, progress);
  write_scene(scene, options.output, progress);
  line.clear();
  print_notes(stats.notes);
  if (!options.stats_json.empty()) write_text_file(build_stats_json(stats) + '\n', options.stats_json);
  std::fputs(build_summary(stats, options.output).c_str(), stdout);
  return static_cast<int>(ExitCode::done);
}

}  // namespace

int main(int argc, char** argv) { return run_main("splatray-preprocess", run, argc, argv); }
