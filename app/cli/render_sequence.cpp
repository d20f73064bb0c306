#include "app/cli/render_sequence.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "app/cli/command_line.h"
#include "app/cli/denoise.h"
#include "app/cli/picture.h"
#include "app/cli/reproduce.h"
#include "engine/base/error.h"
#include "engine/base/interrupt.h"

namespace splatray {
namespace {

/// Most samples of a pixel of a picture that is traced until it is good enough.
constexpr std::uint32_t GOAL_SAMPLES = 65536;

/// What all pictures of a run share.
struct Run {
  const RenderOptions& options;
  const LoadedScene& loaded;
  const Context& context;
  Tracer& tracer;
  ProgressLine& progress;
};

/// Traces and writes one picture; `stage` names it on the progress line.
void make_picture(const Run& run, const Camera& camera, const SequenceFrame& frame, const std::string& stage,
                  SequenceRecord& record) {
  const View view{camera, run.options.picture.width, run.options.picture.height, run.options.window()};
  const std::vector<SceneLight> lights = choose_lights(run.loaded, run.options.picture, camera);
  run.tracer.set_lights(lights);
  const auto progress = [&](double share) {
    run.progress.show(stage, share);
    return !interrupted();
  };
  Settings settings = choose_settings(run.loaded.scene, run.options.picture);
  settings.aov = settings.aov || run.options.denoise;
  settings.estimate_error = settings.estimate_error || run.options.denoise;
  if (run.options.has_goal()) {
    settings.samples = GOAL_SAMPLES;
    Goal goal{.error = run.options.error_goal};
    if (run.options.seconds_goal > 0.0) goal.seconds = run.options.seconds_goal;
    record.last = run.tracer.render_until(view, settings, goal, progress);
  } else {
    record.last = run.tracer.render(view, settings, progress);
  }
  const RenderStats stats = run.tracer.stats();
  Metadata metadata = picture_metadata(run.options, run.loaded.scene, view, run.context);
  double denoise_ms = 0.0;
  Stopwatch watch;
  run.progress.clear();
  if (run.options.denoise) {
    const std::string denoiser = remove_noise(run.tracer, view, settings, record.last);
    metadata.emplace_back("denoised", denoiser);
    denoise_ms = watch.lap_ms();
    if (!run.options.quiet) std::fprintf(stderr, "splatray-render: denoised by %s\n", denoiser.c_str());
  }
  write_output(run.options, record.last, metadata, frame.output);
  record.made.push_back({frame, lights.size(), stats, watch.lap_ms(), denoise_ms});
}

/// The command of these options, its files spelt in one way.
std::string plain_command(RenderOptions options) {
  const auto plain = [](const std::filesystem::path& file) {
    std::error_code error;
    const std::filesystem::path found =
        std::filesystem::weakly_canonical(std::filesystem::absolute(file, error), error);
    return error ? file : found;
  };
  for (std::filesystem::path& input : options.scene.inputs) input = plain(input);
  for (std::filesystem::path& folder : options.scene.data_paths) folder = plain(folder);
  std::string& environment = options.picture.environment;
  if (!environment.empty() && !built_in_environment(environment)) environment = plain(environment).string();
  return command_line(options);
}

/// Whether the picture is there, whole, and made by the command that would make it now.
bool is_made(const RenderOptions& options, const Camera& camera, const std::filesystem::path& path) {
  if (!is_whole_picture(path)) return false;
  const Metadata metadata = read_metadata(path);
  const auto kept = std::find_if(metadata.begin(), metadata.end(),
                                 [](const auto& entry) { return entry.first == "command_line"; });
  if (kept == metadata.end()) return false;
  const RenderOptions still = still_options(options, camera);
  if (kept->second == command_line(still)) return true;
  try {
    return plain_command(parse_command_line(kept->second)) == plain_command(still);
  } catch (const Error&) {
    return false;  // another version's
  }
}

}  // namespace

SequenceRecord render_sequence(const RenderOptions& options, const Sequence& sequence,
                               const LoadedScene& loaded, const Camera& still, const Context& context,
                               Tracer& tracer, ProgressLine& progress) {
  const Run run{options, loaded, context, tracer, progress};
  SequenceRecord record;
  for (const SequenceFrame& frame : sequence.frames) {
    stop_if_interrupted();
    const std::string stage = options.sequence.many() ? "frame " + std::to_string(frame.number) : "tracing";
    try {
      const Camera camera = frame_camera(sequence, frame.number, still, loaded.scene.up);
      if (options.sequence.skip_existing && is_made(options, camera, frame.output)) continue;
      make_picture(run, camera, frame, stage, record);
    } catch (const Error& error) {
      if (!options.sequence.many() || error.code() == ExitCode::interrupted) throw;
      progress.clear();
      std::fprintf(stderr, "splatray-render: error: frame %u: %s\n", frame.number, error.what());
      record.failed.push_back(frame);
    }
  }
  return record;
}

void require_all_made(const SequenceRecord& record) {
  if (record.failed.empty()) return;
  throw Error(ExitCode::failed, std::to_string(record.failed.size()) + " of " +
                                    std::to_string(record.failed.size() + record.made.size()) +
                                    " frames failed, the first is '" + record.failed.front().output.string() +
                                    "'");
}

}  // namespace splatray
