#include "app/library/picture/series/make.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <utility>

#include "app/library/picture/picture_file.h"
#include "app/library/picture/reproduce.h"
#include "app/library/picture/series/film.h"
#include "app/library/picture/series/orbit.h"
#include "app/library/picture/series/sheets.h"
#include "app/library/request/command_line.h"
#include "app/library/sheet/sheet_files.h"
#include "engine/base/error.h"
#include "engine/base/interrupt.h"
#include "engine/base/stopwatch.h"
#include "preprocess/base/file_extension.h"

namespace splatray {
namespace {

/// What all pictures of a run share.
struct Run {
  const Shot& shot;
  SceneOnDevice& shown;
  const SequenceListener& listener;
};

/// How far a picture of --error or --time came.
std::string goal_text(const RenderStats& stats) {
  std::array<char, 100> text{};
  (void)std::snprintf(text.data(), text.size(),
                      "traced %.1f samples a pixel, with an estimated error of %.2g %%", stats.samples,
                      100.0 * stats.error);
  return text.data();
}

/// Writes a picture that was stopped, as the one of fewer samples that it is, and beside all but an EXR the EXR that --resume needs.
/// Throws Error (interrupted), which says so.
[[noreturn]] void write_unfinished(const Run& run, const Camera& camera, const SequenceFrame& frame,
                                   const MadePicture& made) {
  Shot shot = run.shot;
  const std::uint32_t asked = shot.settings.samples;
  shot.settings.samples = shot.request.settings.samples = asked - made.samples_missing;
  shot.request.output.denoise.reset();
  std::erase_if(shot.choices, [](const FieldText& choice) { return choice.name == "denoise"; });
  shot.request.output.despeckle = false;
  const Metadata metadata = picture_metadata(shot, run.shown.scene(), camera, made.devices);
  const bool has_sums = lower_extension(frame.output) == ".exr";
  const std::filesystem::path sums = has_sums ? frame.output : unfinished_file(frame.output);
  if (!has_sums) write_output(shot, made.image, metadata, sums);
  write_output(shot, made.image, metadata, frame.output);
  throw Error(ExitCode::interrupted, "interrupted by a signal after " +
                                         std::to_string(shot.settings.samples) + " of " +
                                         std::to_string(asked) + " samples, which '" + frame.output.string() +
                                         "' has; --resume '" + sums.string() + "' goes on from them");
}

/// Makes and writes one picture, `before` others having come before it.
void write_picture(const Run& run, const Camera& camera, const SequenceFrame& frame, std::size_t before,
                   SequenceRecord& record) {
  // A frame of a sequence is whole or absent, as those who take it up look for files.
  const Stopped stopped = run.shot.is_sequence() ? Stopped::dropped : run.listener.stopped;
  bool told = stopped == Stopped::dropped || run.shot.request.settings.has_goal();
  const auto progress = [&](double share) {
    const bool goes_on = run.listener.progress(frame, before, share);
    const bool signalled = interrupted();  // asked once and last: a signal that stops this is told
    if (signalled && !std::exchange(told, true))
      run.listener.note(
          "a signal came: all pixels get their first sample and what they have is written; a second signal "
          "ends this at once");
    return goes_on && !signalled;
  };
  if (stopped == Stopped::kept) take_time_to_end();
  MadePicture made = make_picture(run.shot, run.shown, camera, progress, stopped);
  for (const std::string& note : made.notes) run.listener.note("note: " + note);
  if (run.shot.request.settings.has_goal()) run.listener.note(goal_text(made.stats));
  if (made.samples_missing > 0) write_unfinished(run, camera, frame, made);
  Metadata metadata = picture_metadata(run.shot, run.shown.scene(), camera, made.devices);
  if (!made.denoiser.empty()) {
    metadata.emplace_back("denoised", made.denoiser);
    run.listener.note("denoised by " + made.denoiser);
  }
  Stopwatch watch;
  Shot drawn = run.shot;
  if (made.sheet) drawn.output = std::move(*made.sheet);
  write_output(drawn, made.image, metadata, frame.output);
  record.made.push_back({frame, made.lights, made.stats, watch.lap_ms(), made.denoise_ms});
  record.last = std::move(made.image);
}

/// Whether the picture is there, whole, and made by the command that would make it now.
bool is_made(const Shot& shot, const Camera& camera, const std::filesystem::path& path) {
  if (!is_whole_picture(path)) return false;
  const Metadata metadata = read_metadata(path);
  const auto kept = std::find_if(metadata.begin(), metadata.end(),
                                 [](const auto& entry) { return entry.first == "command_line"; });
  if (kept == metadata.end()) return false;
  const Request still = still_request(shot, camera);
  if (kept->second == command_line(still)) return true;
  try {
    return command_line(plain_request(parse_command_line(kept->second))) ==
           command_line(plain_request(still));
  } catch (const Error&) {
    return false;  // another version's
  }
}

}  // namespace

std::filesystem::path unfinished_file(std::filesystem::path picture) {
  return picture.replace_extension(".unfinished.exr");
}

SequenceRecord make(const Shot& shot, SceneOnDevice& shown, const SequenceListener& listener) {
  if (shot.is_orbit()) return make_orbit(shot, shown, listener);
  if (shot.sheet() != nullptr || shot.sheet_set() != nullptr) require_page(shot);
  if (shot.sheet_set() != nullptr) return make_sheets(shot, shown, listener);
  const FilmFolder folder(shot.request.output);
  SequenceRecord record;
  std::size_t before = 0;
  for (const SequenceFrame& frame : shot.frames) {
    stop_if_interrupted();
    try {
      const Camera camera = frame_camera(shot, frame.number, shown.scene());
      const Shot one = frame_shot(shot, frame.number);
      if (!shot.request.output.skip_existing || !is_made(one, camera, frame.output))
        write_picture({one, shown, listener}, camera, frame, before, record);
      else if (++record.skipped; !listener.progress(frame, before, 1.0))
        throw Error(ExitCode::interrupted, "rendering was interrupted");
    } catch (const Error& error) {
      if (!shot.is_sequence() || error.code() == ExitCode::interrupted) throw;
      listener.failed(record.failed.emplace_back(FailedPicture{frame, error.what()}));
    }
    ++before;
  }
  if (!shot.request.output.film.empty() && record.failed.empty())
    write_film(shot.request.output, shot.frames);
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
