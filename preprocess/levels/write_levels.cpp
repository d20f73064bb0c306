#include "preprocess/levels/write_levels.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include "engine/base/error.h"
#include "preprocess/base/parallel.h"
#include "preprocess/base/thread_limit.h"
#include "preprocess/levels/build_levels.h"
#include "preprocess/levels/divide_points.h"
#include "preprocess/levels/level_folder.h"
#include "preprocess/levels/point_batches.h"

namespace splatray {
namespace {

/// What a job is of, so that another is known.
std::string source_of(const std::vector<std::filesystem::path>& files, const ReadOptions& options) {
  std::string text = options.scans.keep_withheld ? "with withheld points; " : "";
  for (const std::string& name : options.scans.attributes) text += name + "; ";
  for (const std::filesystem::path& file : files) {
    std::error_code error;
    const std::uintmax_t bytes = std::filesystem::file_size(file, error);
    const auto time = std::filesystem::last_write_time(file, error).time_since_epoch().count();
    text += file.filename().string() + ' ' +
            (error ? "" : std::to_string(bytes) + ' ' + std::to_string(time)) + "; ";
  }
  return text;
}

[[noreturn]] void refuse_undivided(const LevelFolder& folder) {
  throw Error(ExitCode::usage,
              folder.ept_json().string() +
                  ": found points that are not divided, expected the step 'divide' before this one");
}

/// The job of the folder, which dividing begins where there is none.
LevelJob job_of(PointBatches& batches, const ReadOptions& options, const LevelSteps& steps,
                const LevelFolder& folder, const Progress& progress) {
  const std::string source = source_of(batches.files(), options);
  if (std::optional<LevelJob> kept = folder.job()) {
    if (kept->source == source) return std::move(*kept);
    throw Error(ExitCode::usage,
                folder.ept_json().string() +
                    ": found levels in the making there of other files or options, expected the "
                    "same or another folder");
  }
  if (!steps.divide) refuse_undivided(folder);
  LevelJob job = plan_levels(batches, steps.most_part_points, progress);
  job.source = source;
  folder.keep(job);
  return job;
}

/// Builds the parts of a share, as many at a time as there are threads.
void build_parts(const LevelJob& job, const LevelSteps& steps, const LevelFolder& folder,
                 const Progress& progress) {
  std::vector<std::size_t> parts;
  for (std::size_t part = steps.share; part < job.plan.parts.size(); part += steps.shares)
    parts.push_back(part);
  const std::size_t at_once = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  for (std::size_t done = 0; done < parts.size(); done += at_once) {
    Stage{"building", progress}.report(static_cast<double>(done) / static_cast<double>(parts.size()));
    tbb::parallel_for(done, std::min(done + at_once, parts.size()),
                      [&](std::size_t i) { build_part(job, parts[i], steps.most_part_points, folder); });
  }
}

}  // namespace

LevelSteps level_steps(const std::string& text) {
  if (text == "divide") return {.divide = true, .build = false, .join = false};
  if (text == "join") return {.divide = false, .build = false, .join = true};
  LevelSteps steps{.divide = false, .build = true, .join = false};
  std::size_t share = 0;
  const char* const end = text.data() + text.size();
  const auto [slash, first] = std::from_chars(text.data(), end, share);
  if (first == std::errc{} && slash != end && *slash == '/') {
    const auto [last, second] = std::from_chars(slash + 1, end, steps.shares);
    steps.share = share - 1;
    if (second == std::errc{} && last == end && share >= 1 && share <= steps.shares) return steps;
  }
  throw Error(ExitCode::usage,
              "found step '" + text + "', expected divide, a share of the parts such as 2/16, or join");
}

bool is_levels_output(const std::filesystem::path& path) { return path.filename() == "ept.json"; }

LevelsMade write_levels(const std::vector<std::filesystem::path>& inputs, const ReadOptions& asked,
                        const LevelSteps& steps, const std::filesystem::path& ept_json) {
  if (std::filesystem::exists(ept_json))
    throw Error(ExitCode::usage,
                ept_json.string() + ": found a scan in levels there, expected a folder without one");
  const ThreadLimit limit(asked.threads);
  // Readers say how far a file is; what counts is how far all files are.
  const char* stage = "counting";
  double share = 0.0;
  const auto go_on = [&] { return !asked.progress || asked.progress(stage, share); };
  ReadOptions options = asked;
  options.progress = [&](const char*, double) { return go_on(); };
  const Progress progress = [&](const char* reached, double so_far) {
    stage = reached, share = so_far;
    return go_on();
  };
  PointBatches batches(inputs, options);
  const LevelFolder folder(ept_json);
  const LevelJob job = job_of(batches, options, steps, folder, progress);
  if (steps.divide) divide_points(batches, job, folder, progress);
  if (folder.divided(job.plan.parts.size()).batches < batches.size()) refuse_undivided(folder);
  if (steps.build) build_parts(job, steps, folder, progress);
  LevelsMade made{job.points, job.plan.parts.size(), 0, batches.notes()};
  if (steps.join) {
    const BuiltNodes nodes = join_parts(job, folder, progress);
    folder.finish(job, nodes);
    made.nodes = nodes.points.size();
  }
  return made;
}

}  // namespace splatray
