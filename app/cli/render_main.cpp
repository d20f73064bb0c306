/// splatray-render: a scene in, pictures out.
#include <algorithm>
#include <cstdio>
#include <future>

#include "app/cli/load_reporting.h"
#include "app/cli/render_options.h"
#include "app/cli/stats_json.h"
#include "app/cli/typical_work.h"
#include "app/library/image_file.h"
#include "app/library/picture/picture_file.h"
#include "app/library/picture/picture_notes.h"
#include "app/library/picture/series/orbit.h"
#include "app/library/picture/series/render_sequence.h"
#include "app/library/picture/series/run_files.h"
#include "app/library/user_folders.h"
#include "engine/base/error.h"
#include "engine/base/interrupt.h"
#include "engine/base/number_text.h"
#include "engine/base/progress.h"
#include "preprocess/base/file_extension.h"

namespace {

using namespace splatray;

int print_devices() {
  const std::vector<DeviceInfo> devices = list_devices();
  for (std::size_t i = 0; i < devices.size(); ++i)
    std::printf("%zu: %s (%s), %s, Vulkan %s%s%s\n", i, devices[i].name.c_str(), devices[i].type.c_str(),
                devices[i].driver.c_str(), devices[i].api.c_str(),
                devices[i].refused.empty() ? "" : "; unusable: ", devices[i].refused.c_str());
  std::printf("%s: %s\n", HOST_DEVICE, open_device(HOST_DEVICE)->info().name.c_str());
  return static_cast<int>(ExitCode::done);
}

/// Decides the exposure where that is left to the picture. Of EXR files too, which keep it for what makes PNGs of them.
void expose(const Sequence& sequence, SceneOnDevice& shown, const Camera& still, Request& request) {
  if (!suits_exposure(shown.scene(), request)) return;
  const std::uint32_t first = sequence.path.empty() ? 0 : sequence.path.front().frame;
  const Camera camera = frame_camera(sequence, first, still, choose_up(shown.scene(), request));
  request.look.exposure_ev = preview_exposure_ev(request, shown, camera);
}

/// The request with what suits the scan where nothing is asked for.
Request suited(const Request& asked, const LoadedScene& loaded) {
  Request request = loaded.request;
  request.settings.aov = request.settings.aov || request.output.orbit_columns > 0;
  const bool shows = lower_extension(request.output.path) != ".exr" && !request.view.xray;
  request.output.denoise = request.output.denoise || (shows && suits_denoising(loaded.scene, asked));
  require_picture_memory(request);
  return request;
}

/// Says in a line what was chosen for a scan, as the options that would choose it.
void report_choices(const Request& asked, const Request& request, const LoadedScene& loaded) {
  if (request.output.quiet || loaded.choices.empty()) return;
  std::string choices = loaded.choices;
  if (request.look.exposure_ev && !asked.look.exposure_ev)
    choices += " --exposure " + number_text(*request.look.exposure_ev);
  if (request.output.denoise && !asked.output.denoise) choices += " --denoise";
  std::fprintf(stderr, "splatray-render: %s\n", choices.c_str());
}

/// Writes the run's progress and sentences to stderr.
SequenceListener reporting_on(ProgressLine& progress, const Request& request, std::size_t pictures) {
  const auto say = [&progress](const std::string& sentence) {
    progress.clear();
    std::fprintf(stderr, "splatray-render: %s\n", sentence.c_str());
  };
  return {[&progress, &request, pictures](const SequenceFrame& frame, std::size_t before, double share) {
            const bool several = request.output.many() || request.output.orbit_columns > 0;
            const double all = (static_cast<double>(before) + share) / static_cast<double>(pictures);
            progress.show("tracing", all, several ? "frame " + std::to_string(frame.number) : "");
            return true;
          },
          [&request, say](const std::string& note) {
            if (!request.output.quiet) say(note);
          },
          [say](const FailedPicture& picture) {
            say("error: frame " + std::to_string(picture.frame.number) + ": " + picture.reason);
          }};
}

int render(int argc, char** argv) {
  const std::optional<GivenRequest> given = parse_render_options(argc, argv);
  if (!given) return static_cast<int>(ExitCode::done);
  const Request& asked = given->request;
  if (asked.output.list_devices) return print_devices();
  const auto note = [&asked](const std::string& sentence) {
    if (!asked.output.quiet) std::fprintf(stderr, "splatray-render: note: %s\n", sentence.c_str());
  };
  std::for_each(given->notes.begin(), given->notes.end(), note);

  const Sequence sequence = plan_sequence(asked);
  if (sequence.frames.empty()) return static_cast<int>(ExitCode::done);
  note_inputs(asked);
  require_inputs_present(asked);
  claim_outputs(asked, sequence);
  require_outputs_writable(asked);
  require_picture_memory(asked);
  static_cast<void>(read_reference(asked));  // refused before any work
  catch_interrupts();
  StageTimes times;
  Stopwatch watch;
  const std::unique_ptr<Device> device = open_device(asked.settings.device);
  if (!asked.output.quiet) std::fprintf(stderr, "splatray-render: device: %s\n", device->info().name.c_str());
  times.device_ms = watch.lap_ms();

  // After the driver is there, as one library is loaded at a time.
  const std::future<void> codec = std::async(std::launch::async, load_image_codec);
  ProgressLine progress(asked.output.quiet, asked.output.progress, work_of_pictures(asked, sequence));
  LoadedScene loaded = load_reporting(asked, "splatray-render", progress);
  Request request = suited(asked, loaded);
  for (const std::string& sentence : ignored_options(asked, choose_look(loaded.scene, request)))
    note(sentence);
  // What is asked of the pools, before they go.
  const Camera still = choose_camera(loaded.scene, request);
  const PoolCounts counts = pool_counts(loaded.scene);

  watch.lap_ms();
  SceneOnDevice shown(*device, {.pipeline_folder = user_cache_folder(), .threads = request.source.threads});
  shown.show_environment(loaded.environment_name, note);
  shown.open_and_free(loaded.scene);
  times.upload_ms = watch.lap_ms();
  expose(sequence, shown, still, request);
  times.exposure_ms = watch.lap_ms();
  report_choices(asked, request, loaded);
  const SequenceListener listener = reporting_on(progress, request, pictures_of(request, sequence));
  const SequenceRecord record = request.output.orbit_columns > 0
                                    ? render_orbit(request, shown, still, listener)
                                    : render_sequence(request, sequence, shown, still, listener);
  progress.clear();

  if (!request.output.stats_json.empty())
    write_stats(request, loaded, counts, *device, shown.tracer().pool_bytes(), times, record);
  require_all_made(record);
  // In the exposure of the picture, which is known by now.
  if (const auto reference = read_reference(request)) require_match(request, record.last, *reference);
  return static_cast<int>(ExitCode::done);
}

}  // namespace

int main(int argc, char** argv) { return splatray::run_main("splatray-render", render, argc, argv); }
