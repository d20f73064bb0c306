#include "app/library/picture/make_picture.h"

#include <algorithm>

#include "app/library/codec/picture_format.h"
#include "app/library/picture/denoise.h"
#include "app/library/picture/picture_file.h"
#include "app/library/picture/resume.h"
#include "app/library/picture/xray.h"
#include "app/library/sheet/draw_cut.h"
#include "app/library/sheet/ink.h"
#include "app/library/shot/picture_lights.h"
#include "engine/base/stopwatch.h"
#include "engine/image/fireflies.h"

namespace splatray {
namespace {

/// Most samples of a pixel of a picture that is traced until it is good enough.
constexpr std::uint32_t GOAL_SAMPLES = 65536;

/// The picture of all samples, or those behind the ones of --resume.
void render_samples(const Shot& shot, SceneOnDevice& shown, const Look& look, const View& view,
                    const Settings& settings, const Tracer::Progress& progress, Stopped stopped,
                    MadePicture& made) {
  const auto started = read_started(shot, shown.scene(), view.camera, shown.device());
  Settings rest = settings;
  if (started) {
    rest.samples -= started->samples;
    rest.sample_offset += started->samples;
    rest.estimate_error = false;
  }
  made.image = shown.tracer().render(look, view, rest, progress, stopped);
  made.stats = shown.tracer().stats();
  made.samples_missing = rest.samples - static_cast<std::uint32_t>(made.stats.samples);
  if (!started) return;
  add_started(*started, settings.estimate_error, made.image, made.stats);
  made.devices = joined_devices(started->devices, made.devices);
}

/// The picture as it is traced, without the lines of a drawing.
MadePicture traced_picture(const Shot& shot, SceneOnDevice& shown, const Camera& camera,
                           const Tracer::Progress& progress, Stopped stopped) {
  View view = shot.view;
  view.camera = camera;
  const Request& request = shot.request;
  Settings settings = shot.traced_settings();
  LitLook lit = lit_look(shot, shown, camera);
  const Look& look = lit.look;
  MadePicture made;
  made.devices = device_text(shown.device());
  made.lights = look.lights.size();
  made.notes = std::move(lit.notes);
  if (request.settings.has_goal()) {
    settings.samples = GOAL_SAMPLES;
    Goal goal{.error = request.settings.error_goal};
    if (request.settings.seconds_goal > 0.0) goal.seconds = request.settings.seconds_goal;
    made.image = shown.tracer().render_until(look, view, settings, goal, progress);
    made.stats = shown.tracer().stats();
  } else {
    render_samples(shot, shown, look, view, settings, progress, stopped, made);
  }
  if (made.samples_missing > 0) return made;
  if (request.output.despeckle) made.image = without_fireflies(std::move(made.image));
  if (!shot.denoises()) return made;
  Stopwatch watch;
  made.denoiser = remove_noise(made.image, base_colors(shown.tracer(), look, view, settings));
  made.denoise_ms = watch.lap_ms();
  return made;
}

/// Lines of a sheet's part, for which more of the sheet is seen than the part.
void draw_lines(const Shot& shot, const Sheet& sheet, SceneOnDevice& shown, const PixelWindow& part,
                Image& image) {
  const PixelWindow window = ink_window(sheet, part);
  if (window == part && !image.aov.empty()) return draw_ink(sheet, {window, image.aov}, part, image);
  const std::vector<AovPixel> aov = shown.tracer().trace_aov(
      shown.look(), {shot.view.camera, sheet.width, sheet.height, window}, shot.settings);
  draw_ink(sheet, {window, aov}, part, image);
}

}  // namespace

MadePicture make_picture(const Shot& shot, SceneOnDevice& shown, const Camera& camera,
                         const Tracer::Progress& progress, Stopped stopped) {
  const Sheet* sheet = shot.sheet();
  if (sheet == nullptr) return traced_picture(shot, shown, camera, progress, stopped);
  const PixelWindow window = shot.view.made();
  MadePicture made;
  made.devices = device_text(shown.device());
  if (lower_extension(shot.request.output.path) == ".dxf") return made;  // has no pixels
  if (shot.request.view.xray) {
    made.image =
        xray_image(shown.scene(), shown.look().materials, *sheet, window, shot.settings.region, progress);
  } else {
    made = traced_picture(shot, shown, camera, progress, stopped);
  }
  if (made.samples_missing > 0) return made;
  if (shot.request.view.ink) draw_lines(shot, *sheet, shown, window, made.image);
  clear_solids(*sheet, window, made.image);
  if (!is_line_format(shot.request.output.path)) draw_cut(*sheet, window, made.image);
  return made;
}

}  // namespace splatray
