#include "app/library/picture/render_sequence.h"

#include <algorithm>
#include <utility>

#include "app/library/picture/picture_file.h"
#include "app/library/picture/reproduce.h"
#include "app/library/request/command_line.h"
#include "engine/base/error.h"
#include "engine/base/interrupt.h"
#include "engine/base/stopwatch.h"

namespace splatray {
namespace {

/// What all pictures of a run share.
struct Run {
  const Request& request;
  SceneOnDevice& shown;
  const SequenceListener& listener;
};

/// Makes and writes one picture, `before` others having come before it.
void write_picture(const Run& run, const Camera& camera, const SequenceFrame& frame, std::size_t before,
                   SequenceRecord& record) {
  const auto progress = [&](double share) {
    return run.listener.progress(frame, before, share) && !interrupted();
  };
  MadePicture made = make_picture(run.request, run.shown, camera, progress);
  for (const std::string& note : made.notes) run.listener.note("note: " + note);
  const Request::View& asked = run.request.view;
  Metadata metadata =
      picture_metadata(run.request, run.shown.scene(), {camera, asked.width, asked.height, asked.window()},
                       run.shown.context());
  if (!made.denoiser.empty()) {
    metadata.emplace_back("denoised", made.denoiser);
    run.listener.note("denoised by " + made.denoiser);
  }
  Stopwatch watch;
  write_output(run.request, made.image, metadata, frame.output);
  record.made.push_back({frame, made.lights, made.stats, watch.lap_ms(), made.denoise_ms});
  record.last = std::move(made.image);
}

/// The command of a request, its files spelt in one way.
std::string plain_command(Request request) {
  const auto plain = [](const std::filesystem::path& file) {
    std::error_code error;
    const std::filesystem::path found =
        std::filesystem::weakly_canonical(std::filesystem::absolute(file, error), error);
    return error ? file : found;
  };
  for (std::filesystem::path& input : request.source.inputs) input = plain(input);
  for (std::filesystem::path& folder : request.source.data_paths) folder = plain(folder);
  std::string& environment = request.look.environment;
  if (!environment.empty() && !built_in_environment(environment)) environment = plain(environment).string();
  return command_line(request);
}

/// Whether the picture is there, whole, and made by the command that would make it now.
bool is_made(const Request& request, const Camera& camera, const std::filesystem::path& path) {
  if (!is_whole_picture(path)) return false;
  const Metadata metadata = read_metadata(path);
  const auto kept = std::find_if(metadata.begin(), metadata.end(),
                                 [](const auto& entry) { return entry.first == "command_line"; });
  if (kept == metadata.end()) return false;
  const Request still = still_request(request, camera);
  if (kept->second == command_line(still)) return true;
  try {
    return plain_command(parse_command_line(kept->second)) == plain_command(still);
  } catch (const Error&) {
    return false;  // another version's
  }
}

}  // namespace

SequenceRecord render_sequence(const Request& request, const Sequence& sequence, SceneOnDevice& shown,
                               const Camera& still, const SequenceListener& listener) {
  const Run run{request, shown, listener};
  SequenceRecord record;
  std::size_t before = 0;
  for (const SequenceFrame& frame : sequence.frames) {
    stop_if_interrupted();
    try {
      const Camera camera = frame_camera(sequence, frame.number, still, choose_up(shown.scene(), request));
      if (!request.output.skip_existing || !is_made(request, camera, frame.output))
        write_picture(run, camera, frame, before, record);
      else if (++record.skipped; !listener.progress(frame, before, 1.0))
        throw Error(ExitCode::interrupted, "rendering was interrupted");
    } catch (const Error& error) {
      if (!request.output.many() || error.code() == ExitCode::interrupted) throw;
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
