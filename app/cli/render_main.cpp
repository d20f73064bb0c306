/// splatray-render: a scene in, pictures out.
#include <algorithm>
#include <cstdio>
#include <future>

#include "app/cli/load_reporting.h"
#include "app/cli/render_options.h"
#include "app/cli/stats_json.h"
#include "app/cli/typical_work.h"
#include "app/library/image_file.h"
#include "app/library/picture/lod_error.h"
#include "app/library/picture/picture_file.h"
#include "app/library/picture/series/make.h"
#include "app/library/picture/series/run_files.h"
#include "app/library/shot/picture_lights.h"
#include "app/library/shot/resolve.h"
#include "app/library/user_folders.h"
#include "engine/base/error.h"
#include "engine/base/interrupt.h"
#include "engine/base/progress.h"

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

/// Says in a line what was chosen, as the options that would choose it.
void report_choices(const Shot& shot) {
  if (shot.request.output.quiet || shot.choices.empty()) return;
  const std::string of = shot.of.empty() ? "chosen" : shot.of;
  std::fprintf(stderr, "splatray-render: %s: %s\n", of.c_str(), choices_text(shot).c_str());
}

/// Writes the run's progress and sentences to stderr.
SequenceListener reporting_on(ProgressLine& progress, const Shot& shot) {
  const auto say = [&progress](const std::string& sentence) {
    progress.clear();
    std::fprintf(stderr, "splatray-render: %s\n", sentence.c_str());
  };
  const auto pictures = static_cast<double>(pictures_of(shot));
  const bool several = shot.is_sequence() || shot.is_orbit(), quiet = shot.request.output.quiet;
  return {[&progress, several, pictures](const SequenceFrame& frame, std::size_t before, double share) {
            const double all = (static_cast<double>(before) + share) / pictures;
            progress.show("tracing", all, several ? "frame " + std::to_string(frame.number) : "");
            return true;
          },
          [quiet, say](const std::string& note) {
            if (!quiet) say(note);
          },
          [say](const FailedPicture& picture) {
            say("error: frame " + std::to_string(picture.frame.number) + ": " + picture.reason);
          },
          Stopped::kept};
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

  const Shot planned = draft(asked);
  if (planned.frames.empty()) return static_cast<int>(ExitCode::done);
  note_inputs(asked);
  require_inputs_present(asked);
  claim_outputs(asked, planned.frames);
  require_outputs_writable(asked);
  require_picture_memory(planned);
  static_cast<void>(read_reference(asked));  // refused before any work
  catch_interrupts();
  StageTimes times;
  Stopwatch watch;
  const std::unique_ptr<Device> device = open_device(asked.settings.device);
  if (!asked.output.quiet) std::fprintf(stderr, "splatray-render: device: %s\n", device->info().name.c_str());
  times.device_ms = watch.lap_ms();

  // After the driver is there, as one library is loaded at a time.
  const std::future<void> codec = std::async(std::launch::async, load_image_codec);
  ProgressLine progress(asked.output.quiet, asked.output.progress, work_of_pictures(planned));
  LoadedScene loaded = load_reporting(asked, "splatray-render", progress);
  Shot shot = resolve(asked, loaded.scene, loaded.facts);
  require_picture_memory(shot);
  std::for_each(shot.notes.begin(), shot.notes.end(), note);
  const PoolCounts counts = pool_counts(loaded.scene);  // before the pools go

  watch.lap_ms();
  SceneOnDevice shown(*device, {.pipeline_folder = user_cache_folder(), .threads = asked.source.threads});
  shown.show_environment(shot.environment, note);
  if (shot.request.view.xray)
    shown.open(loaded.scene);  // xray_image reads the splats
  else
    shown.open_and_free(loaded.scene, [&] { prepare_programs(shot, shown); });
  times.upload_ms = watch.lap_ms();
  expose(shot, shown, loaded.facts);
  times.exposure_ms = watch.lap_ms();
  report_choices(shot);
  measure_lod_error(shot, shown, loaded, note);
  const SequenceRecord record = make(shot, shown, reporting_on(progress, shot));
  progress.clear();

  if (!asked.output.stats_json.empty())
    write_stats(shot, loaded, counts, *device, shown.tracer().pool_bytes(), times, record);
  require_all_made(record);
  // In the exposure of the picture, which is known by now.
  if (const auto reference = read_reference(shot.request)) require_match(shot, record.last, *reference);
  return static_cast<int>(ExitCode::done);
}

}  // namespace

int main(int argc, char** argv) { return splatray::run_main("splatray-render", render, argc, argv); }
