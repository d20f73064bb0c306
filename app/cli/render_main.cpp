/// splatray-render: a scene in, pictures out.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <future>

#include "app/cli/options.h"
#include "app/cli/picture.h"
#include "app/cli/render_sequence.h"
#include "app/cli/stats_json.h"
#include "app/library/image_file.h"
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
  if (devices.empty())
    throw Error(ExitCode::no_device,
                "found no Vulkan device, expected a driver such as mesa-vulkan-drivers, or --device cpu, "
                "which needs none");
  for (std::size_t i = 0; i < devices.size(); ++i)
    std::printf("%zu: %s (%s), %s, Vulkan %s%s%s\n", i, devices[i].name.c_str(), devices[i].type.c_str(),
                devices[i].driver.c_str(), devices[i].api.c_str(),
                devices[i].refused.empty() ? "" : "; unusable: ", devices[i].refused.c_str());
  std::printf("%s: %s\n", HOST_DEVICE, host_device_info().name.c_str());
  return static_cast<int>(ExitCode::done);
}

LoadedScene load(const RenderOptions& options, ProgressLine& progress) {
  LoadedScene loaded = load_scene(options.scene, options.picture,
                                  {[&](const char* stage, double share) {
                                     progress.show(stage, share);
                                     return !interrupted();
                                   },
                                   [&](const std::string& note) {
                                     progress.clear();
                                     if (!options.quiet)
                                       std::fprintf(stderr, "splatray-render: note: %s\n", note.c_str());
                                   }});
  progress.clear();
  return loaded;
}

/// Decides the exposure where that is left to the picture. Of EXR files too, which keep it for what makes PNGs of them.
void expose(const Sequence& sequence, const Scene& scene, const Camera& still, Tracer& tracer,
            RenderOptions& options) {
  const bool automatic = options.exposure_auto || !scene.stations.empty();
  if (options.exposure_ev || !automatic) return;
  const PictureOptions& picture = options.picture;
  const std::uint32_t first = sequence.path.empty() ? 0 : sequence.path.front().frame;
  const Camera camera = frame_camera(sequence, first, still, choose_up(scene, picture));
  tracer.set_lights(choose_lights(scene, picture, camera));
  const double ev =
      preview_exposure_ev(tracer, {camera, picture.width, picture.height}, choose_settings(scene, picture));
  options.exposure_ev = std::clamp(std::round(100.0 * ev) / 100.0, -60.0, 60.0);
}

/// Takes the noise out of a scan's picture whose look was chosen for it, where it is for looking at.
void choose_denoise(const Scene& scene, RenderOptions& options) {
  const bool asked =
      options.picture.look || options.keep_noise || options.has_goal() || !options.reference.empty();
  if (scene.stations.empty() || asked || options.window().width > 0 || options.picture.settings.samples < 2)
    return;
  options.denoise = options.denoise || lower_extension(options.output) == ".png";
  require_picture_memory(options);
}

/// Says in a line what was chosen for a scan, as the options that would choose it.
void tell_chosen(const RenderOptions& asked, const RenderOptions& options, const LoadedScene& loaded) {
  if (options.quiet || loaded.told.empty()) return;
  std::string told = loaded.told;
  if (options.exposure_ev && !asked.exposure_ev) told += " --exposure " + number_text(*options.exposure_ev);
  if (options.denoise && !asked.denoise) told += " --denoise";
  std::fprintf(stderr, "splatray-render: %s\n", told.c_str());
}

/// Says that materials were asked for in a look that shows none.
void tell_hidden_materials(const RenderOptions& options) {
  const PictureOptions& picture = options.picture;
  const bool asked = !options.scene.material.empty() ||
                     std::any_of(picture.objects.begin(), picture.objects.end(), changes_look);
  if (options.quiet || !asked || !picture.look || shows_materials(*picture.look)) return;
  std::fputs("splatray-render: note: this --look shows no materials, --look lit does\n", stderr);
}

/// Tells the run's progress and sentences on stderr.
SequenceListener told_on(ProgressLine& progress, const RenderOptions& options) {
  const auto say = [&progress](const std::string& sentence) {
    progress.clear();
    std::fprintf(stderr, "splatray-render: %s\n", sentence.c_str());
  };
  return {[&](const SequenceFrame& frame, std::size_t, double share) {
            progress.show(options.sequence.many() ? "frame " + std::to_string(frame.number) : "tracing",
                          share);
            return true;
          },
          [&options, say](const std::string& note) {
            if (!options.quiet) say(note);
          },
          [say](const FailedPicture& picture) {
            say("error: frame " + std::to_string(picture.frame.number) + ": " + picture.reason);
          }};
}

int render(int argc, char** argv) {
  const std::optional<RenderOptions> parsed = parse_render_options(argc, argv);
  if (!parsed) return static_cast<int>(ExitCode::done);
  RenderOptions options = *parsed;
  if (options.list_devices) return print_devices();

  const Sequence sequence = plan_sequence(options);
  if (sequence.frames.empty()) return static_cast<int>(ExitCode::done);
  require_outputs_writable(options);
  require_picture_memory(options);
  const std::optional<DisplayImage> reference = read_reference(options);
  catch_interrupts();
  StageTimes times;
  Stopwatch watch;
  Context context(options.picture.device);
  if (!options.quiet)
    std::fprintf(stderr, "splatray-render: device: %s\n", context.device_info().name.c_str());
  times.device_ms = watch.lap_ms();

  // After the driver is there, as one library is loaded at a time.
  const std::future<void> codec = std::async(std::launch::async, load_image_codec);
  ProgressLine progress(options.quiet, options.progress);
  LoadedScene loaded = load(options, progress);
  choose_denoise(loaded.scene, options);
  options.picture = loaded.picture;
  const Environment environment = choose_environment(loaded.environment_name);

  watch.lap_ms();
  Tracer tracer(context, {.pipeline_folder = user_cache_folder(), .threads = options.scene.threads});
  // What is asked of the pools, before they go.
  const Camera still = choose_camera(loaded.scene, options.picture);
  tell_hidden_materials(options);
  const PoolCounts counts = pool_counts(loaded.scene);
  tracer.upload_and_free(loaded.scene);
  tracer.set_environment(environment);
  expose(sequence, loaded.scene, still, tracer, options);
  tell_chosen(*parsed, options, loaded);
  times.upload_ms = watch.lap_ms();
  const SequenceRecord record =
      render_sequence(options, sequence, loaded.scene, still, context, tracer, told_on(progress, options));
  progress.clear();

  if (!options.stats_json.empty())
    write_stats(options, loaded, counts, context, tracer.pool_bytes(), times, record);
  require_all_made(record);
  if (reference) require_match(options, record.last, *reference);
  return static_cast<int>(ExitCode::done);
}

}  // namespace

int main(int argc, char** argv) { return splatray::run_main("splatray-render", render, argc, argv); }
