#include "app/cli/render_sequence.h"

#include <algorithm>
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
  const Scene& scene;
  const Context& context;
  Tracer& tracer;
  const SequenceListener& listener;
};

/// Traces and writes one picture, `before` others having come before it.
void make_picture(const Run& run, const Camera& camera, const SequenceFrame& frame, std::size_t before,
                  SequenceRecord& record) {
  const View view{camera, run.options.picture.width, run.options.picture.height, run.options.window()};
  const std::vector<SceneLight> lights = choose_lights(run.scene, run.options.picture, camera);
  run.tracer.set_lights(lights);
  const auto progress = [&](double share) {
    return run.listener.progress(frame, before, share) && !interrupted();
  };
  Settings settings = choose_settings(run.scene, run.options.picture);
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
  Metadata metadata = picture_metadata(run.options, run.scene, view, run.context);
  double denoise_ms = 0.0;
  Stopwatch watch;
  if (run.options.denoise) {
    const std::string denoiser = remove_noise(run.tracer, view, settings, record.last);
    metadata.emplace_back("denoised", denoiser);
    denoise_ms = watch.lap_ms();
    run.listener.note("denoised by " + denoiser);
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

SequenceRecord render_sequence(const RenderOptions& options, const Sequence& sequence, const Scene& scene,
                               const Camera& still, const Context& context, Tracer& tracer,
                               const SequenceListener& listener) {
  const Run run{options, scene, context, tracer, listener};
  SequenceRecord record;
  std::size_t before = 0;
  for (const SequenceFrame& frame : sequence.frames) {
    stop_if_interrupted();
    try {
      const Camera camera = frame_camera(sequence, frame.number, still, choose_up(scene, options.picture));
      if (!options.sequence.skip_existing || !is_made(options, camera, frame.output))
        make_picture(run, camera, frame, before, record);
      else if (++record.skipped; !listener.progress(frame, before, 1.0))
        throw Error(ExitCode::interrupted, "rendering was interrupted");
    } catch (const Error& error) {
      if (!options.sequence.many() || error.code() == ExitCode::interrupted) throw;
      listener.failed(record.failed.emplace_back(FailedPicture{frame, error.what()}));
    }
    ++before;
  }
  return record;
}

void require_all_made(const SequenceRecord& record) {
  if (record.failed.empty()) return;
  throw Error(ExitCode::failed, std::to_string(record.failed.size()) + " of " +
                                    std::to_string(record.failed.size() + record.made.size()) +
                                    " frames failed, the first is '" +
                                    record.failed.front().frame.output.string() +
                                    "': " + record.failed.front().reason);
}

}  // namespace splatray
