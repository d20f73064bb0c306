/// splatray-preprocess: points or meshes in, a scene file out.
#include <malloc.h>

#include <chrono>
#include <cstdio>

#include "app/cli/option_types.h"
#include "app/cli/options.h"
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

/// False when help was asked for and printed.
bool parse(int argc, char** argv, Request& request, std::vector<std::string>& notes) {
  OptionList list("Turns points or meshes into a scene of splats for splatray-render and splatray-view.",
                  "splatray-preprocess");
  GivenFields given;
  add_fields(list, DOOR_PREPROCESS, "INPUT", given);
  list.require("INPUT");
  list.set_group(group_title(FieldGroup::files));
  add_path(list, "-o,--output", request.output.path, "scene file to write (.soct)");
  list.require("--output");
  if (!list.parse(argc, argv)) return false;
  assign(request, given, DOOR_PREPROCESS);
  notes = given.notes;
  return true;
}

/// A build takes and frees many large arrays: glibc's malloc keeps their memory instead of giving it back, as each page that the
/// kernel hands out anew costs microseconds.
void keep_freed_memory() {
  constexpr int GROWTH_BYTES = 64 << 20;
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, -1);  // never
  mallopt(M_TOP_PAD, GROWTH_BYTES);
}

Input read(const Request::Source& source, BuildStats& stats, const Progress& progress) {
  const auto start = std::chrono::steady_clock::now();
  Input input = read_input(source.inputs, read_options(source, progress));
  stats.read_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  return input;
}

void print_notes(const std::vector<std::string>& notes) {
  for (const std::string& note : notes) std::fprintf(stderr, "splatray-preprocess: note: %s\n", note.c_str());
}

int run(int argc, char** argv) {
  Request request;
  std::vector<std::string> notes;
  if (!parse(argc, argv, request, notes)) return static_cast<int>(ExitCode::done);
  print_notes(notes);
  const Request::Output& output = request.output;
  require_writable(output.path);
  if (!output.stats_json.empty()) require_writable(output.stats_json);
  catch_interrupts();
  keep_freed_memory();

  ProgressLine line(/*quiet=*/false);
  const Progress progress = watching_memory([&](const char* stage, double share) {
    line.show(stage, share);
    return !interrupted();
  });
  const Request::Source& source = request.source;
  BuildStats stats;
  Input input = read(source, stats, progress);
  line.clear();
  print_notes(input.notes);
  const Scene scene = build_scene(std::move(input), source.params, source.threads, stats, progress);
  write_scene(scene, output.path, progress);
  line.clear();
  print_notes(stats.notes);
  if (!output.stats_json.empty()) write_text_file(build_stats_json(stats) + '\n', output.stats_json);
  std::fputs(build_summary(stats, output.path).c_str(), stdout);
  return static_cast<int>(ExitCode::done);
}

}  // namespace

int main(int argc, char** argv) { return run_main("splatray-preprocess", run, argc, argv); }
