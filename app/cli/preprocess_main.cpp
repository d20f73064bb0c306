/// splatray-preprocess: points or meshes in, a scene file or its points out.
#include <malloc.h>

#include <chrono>
#include <cstdio>
#include <optional>
#include <utility>

#include "app/cli/option_types.h"
#include "app/cli/options.h"
#include "app/cli/typical_work.h"
#include "app/library/picture/change.h"
#include "app/library/picture/series/run_files.h"
#include "engine/base/crs.h"
#include "engine/base/error.h"
#include "engine/base/interrupt.h"
#include "engine/base/memory.h"
#include "engine/base/progress.h"
#include "engine/file/atomic_file.h"
#include "engine/file/file_roles.h"
#include "engine/file/scene_file.h"
#include "engine/scene/scene_splat.h"
#include "preprocess/base/file_extension.h"
#include "preprocess/build.h"
#include "preprocess/build_report.h"
#include "preprocess/levels/write_levels.h"
#include "preprocess/read/formats.h"
#include "preprocess/write/left_out.h"
#include "preprocess/write/write_points.h"

namespace {

using namespace splatray;

struct Options {
  Request request;
  bool keep_dropped = false;
  std::filesystem::path change_from;  ///< empty = no comparison
  std::string step;                   ///< of levels; empty = all
  std::vector<std::string> notes;
};

/// False when help was asked for and printed.
bool parse(int argc, char** argv, Options& options) {
  Request& request = options.request;
  OptionList list("Turns points or meshes into a scene of splats for splatray-render and splatray-view.",
                  "splatray-preprocess");
  GivenFields given;
  add_fields(list, DOOR_PREPROCESS, "INPUT", given);
  list.require("INPUT");
  list.set_group(group_title(FieldGroup::files));
  add_path(list, "-o,--output", request.output.path,
           "scene file to write (.soct), or its points with normals, radii and attributes (.ply, .las, .csv, "
           ".vtp), or FOLDER/ept.json: the points as they are, in levels, of scans of any size");
  list.require("--output");
  list.set_brief("--output", "a scene (.soct), points (.ply, .las, .csv, .vtp), levels (ept.json)");
  list.add_switch(
      "--keep-dropped", options.keep_dropped,
      "with -o of points: those that the scene leaves out are written too, as class 7 (low noise)");
  add_path(
      list, "--change-from", options.change_from,
      "an earlier scan or scene, or a mesh: adds the attribute change, how far each point lies before (+) or "
      "behind (-) its surface");
  add_text(
      list, "--step", options.step,
      "with -o of levels, for several machines: divide, then a share of the parts such as 2/16 for each of "
      "them, then join");
  list.set_brief("--attributes", "further attributes to keep: extra bytes, columns");
  list.set_brief("--keep-withheld", "keep points marked as deleted or as noise");
  list.set_brief("--smooth", "how noise is smoothed; default as it asks for");
  list.set_brief("--z-scale", "factor on heights: 0.3048 for feet beside metres");
  list.set_brief("--change-from", "an earlier scan: how far each point lies from it");
  list.set_examples(
      {{"splatray-preprocess survey.laz -o survey.soct", "read once, show as often as you like"},
       {"splatray-preprocess rooms/*.e57 -o rooms.soct", "several scans in one scene"},
       {"splatray-preprocess survey.laz -o clean.las", "its cleaned points, with normals and radii"},
       {"splatray-preprocess country/ -o levels/ept.json", "more points than memory holds, in levels"}});
  if (!list.parse(argc, argv)) return false;
  assign(request, given, DOOR_PREPROCESS);
  options.notes = given.notes;
  if (!options.step.empty() && !is_levels_output(request.output.path))
    throw Error(ExitCode::usage,
                "found --step with '" + request.output.path.string() + "', expected -o with an ept.json");
  if (options.keep_dropped &&
      (is_levels_output(request.output.path) || !is_point_output(request.output.path)))
    throw Error(ExitCode::usage, "found --keep-dropped with '" + request.output.path.string() +
                                     "', expected -o with a .ply, .las, .csv or .vtp");
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

/// Writes the scene, or its points and what was left out, and says what the format does not hold.
void write(const Scene& scene, const LeftOut& left_out, const std::filesystem::path& path,
           const Progress& progress, ProgressLine& line) {
  if (!is_point_output(path)) return write_scene(scene, path, progress);
  write_points(make_point_table(scene, left_out), path, progress);
  line.clear();
  if (const std::string lost = lost_by_format(scene, path); !lost.empty()) print_notes({lost});
}

/// The scene of a .soct alone, or of the inputs.
Scene load(const Request::Source& source, BuildStats& stats, const Progress& progress) {
  if (is_scene_file(source.inputs.front())) {
    require_scene_alone(source.inputs);
    return read_scene(source.inputs.front(), progress);
  }
  return build_scene(read(source, stats, progress), source.params, source.threads, stats, progress);
}

/// Adds how the scene differs from the earlier one, and says how much that is.
void compare(Scene& scene, const Options& options, const Progress& progress, ProgressLine& line) {
  Request::Source source = options.request.source;
  source.inputs = {options.change_from};
  BuildStats stats;
  const Scene earlier = load(source, stats, progress);
  if (!scene.crs.empty() && !earlier.crs.empty() && !is_same_crs(scene.crs, earlier.crs))
    print_notes({"the two are in the coordinate systems '" + describe_crs(scene.crs).name + "' and '" +
                 describe_crs(earlier.crs).name + "', expected one"});
  const ChangeFound found = add_change(scene, earlier, *open_device(HOST_DEVICE), progress);
  line.clear();
  std::printf("change: %zu of %zu splats meet the earlier surface, median size %.4g", std::size_t{found.met},
              splat_count(scene), found.median_world);
  if (found.significant_world > 0.0)
    std::printf("; %zu differ by more than the %.4g that noise explains (95 %%)",
                std::size_t{found.significant}, found.significant_world);
  std::printf("\n");
}

/// Makes the scene of the inputs and writes it, or its points; what it says goes to the line, which is cleared before.
void make(const Options& options, const Progress& progress, ProgressLine& line) {
  const Request::Source& source = options.request.source;
  const Request::Output& output = options.request.output;
  BuildStats stats;
  Input input = read(source, stats, progress);
  line.clear();
  print_notes(input.notes);
  std::optional<LeftOutPoints> left_out;
  if (options.keep_dropped) left_out.emplace(input);
  Scene scene = build_scene(std::move(input), source.params, source.threads, stats, progress);
  const LeftOut kept = left_out ? std::move(*left_out).take(scene) : LeftOut{};
  if (!options.change_from.empty()) compare(scene, options, progress, line);
  write(scene, kept, output.path, progress, line);
  line.clear();
  print_notes(stats.notes);
  if (!output.stats_json.empty()) write_text_file(build_stats_json(stats) + '\n', output.stats_json);
  std::fputs(build_summary(stats, output.path).c_str(), stdout);
}

/// The same of a scene that is built already.
void convert(const Options& options, const Progress& progress, ProgressLine& line) {
  BuildStats stats;
  Scene scene = load(options.request.source, stats, progress);
  if (!options.change_from.empty()) compare(scene, options, progress, line);
  write(scene, {}, options.request.output.path, progress, line);
}

/// What of a request levels follow: they hold points as they are.
Request::Source kept_by_levels(const Request::Source& source) {
  Request::Source kept;
  kept.inputs = source.inputs;
  kept.threads = source.threads;
  kept.scans.strict = source.scans.strict;
  kept.scans.ignore_checksums = source.scans.ignore_checksums;
  kept.scans.keep_withheld = source.scans.keep_withheld;
  kept.scans.columns = source.scans.columns;
  kept.scans.attributes = source.scans.attributes;
  return kept;
}

/// Writes the inputs as levels.
int make_levels(const Options& options) {
  const Request::Source& source = options.request.source;
  const std::filesystem::path& output = options.request.output.path;
  if (!(kept_by_levels(source) == source) || !options.change_from.empty())
    throw Error(ExitCode::usage,
                "found options of scenes with '" + output.string() +
                    "', expected those of reading alone: what points become is chosen when levels are shown");
  const LevelSteps steps = options.step.empty() ? LevelSteps{} : level_steps(options.step);
  catch_interrupts();
  ProgressLine line(/*quiet=*/false, ProgressStyle::line,
                    {{"counting", 2}, {"dividing", 3}, {"building", 4}, {"joining", 1}});
  const Progress progress = watching_memory([&](const char* stage, double share) {
    line.show(stage, share);
    return !interrupted();
  });
  const LevelsMade made = write_levels(source.inputs, read_options(source, progress), steps, output);
  line.clear();
  print_notes(made.notes);
  std::printf("%llu points in %zu parts", static_cast<unsigned long long>(made.points), made.parts);
  if (made.nodes > 0) std::printf(", %zu nodes -> %s", made.nodes, output.string().c_str());
  std::printf("\n");
  return static_cast<int>(ExitCode::done);
}

int run(int argc, char** argv) {
  Options options;
  if (!parse(argc, argv, options)) return static_cast<int>(ExitCode::done);
  print_notes(options.notes);
  const Request::Output& output = options.request.output;
  if (is_levels_output(output.path)) return make_levels(options);
  const bool is_new = is_point_output(output.path) || !options.change_from.empty();
  note_inputs(options.request);
  note_input(options.change_from);
  require_inputs_present(options.request);
  claim_output(output.path);
  if (!output.stats_json.empty()) claim_output(output.stats_json);
  require_writable(output.path);
  if (!output.stats_json.empty()) require_writable(output.stats_json);
  catch_interrupts();
  keep_freed_memory();

  WorkPlan plan = work_of_scene(options.request.source);
  plan.push_back({"writing", 2});
  ProgressLine line(/*quiet=*/false, ProgressStyle::line, std::move(plan));
  const Progress progress = watching_memory([&](const char* stage, double share) {
    line.show(stage, share);
    return !interrupted();
  });
  if (is_new && is_scene_file(options.request.source.inputs.front()))
    convert(options, progress, line);
  else
    make(options, progress, line);
  return static_cast<int>(ExitCode::done);
}

}  // namespace

int main(int argc, char** argv) { return run_main("splatray-preprocess", run, argc, argv); }
