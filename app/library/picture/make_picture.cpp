#include "app/library/picture/make_picture.h"

#include <algorithm>
#include <cmath>

#include "app/library/display_image.h"
#include "app/library/picture/denoise.h"
#include "app/library/picture/eye_light.h"
#include "app/library/picture/picture_file.h"
#include "app/library/picture/picture_notes.h"
#include "app/library/picture/resume.h"
#include "app/library/picture/scene_source.h"
#include "app/library/picture/xray.h"
#include "app/library/sheet/cut_lines.h"
#include "app/library/sheet/ink.h"
#include "engine/base/stopwatch.h"
#include "engine/image/sparks.h"

namespace splatray {
namespace {

/// Most samples of a pixel of a picture that is traced until it is good enough.
constexpr std::uint32_t GOAL_SAMPLES = 65536;

/// The scene's look in the picture's lights, and what is to be said of them.
struct LitLook {
  Look look;
  std::vector<std::string> notes{};
};
LitLook picture_look(const Request& request, SceneOnDevice& shown, const Camera& camera,
                     const Settings& settings) {
  LitLook lit{shown.look()};
  lit.look.lights = choose_lights(shown.scene(), request, camera);
  const auto at_eye = request.look.lights ? std::nullopt : eye_light(shown, camera, settings);
  if (at_eye) {
    lit.look.lights = {*at_eye};
    lit.notes.emplace_back("no light enters where the camera is, one is put there; --light says others");
  }
  for (std::string& note : missing_light(lit.look, settings)) lit.notes.push_back(std::move(note));
  return lit;
}

/// The picture of all samples, or those behind the ones of --resume.
void render_samples(const Request& request, SceneOnDevice& shown, const Look& look, const View& view,
                    const Settings& settings, const Tracer::Progress& progress, Stopped stopped,
                    MadePicture& made) {
  const auto started = read_started(request, shown.scene(), view.camera, shown.device());
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

/// The picture of a request's own look.
MadePicture traced_picture(const Request& request, SceneOnDevice& shown, const Camera& camera,
                           const Tracer::Progress& progress, Stopped stopped) {
  const View view{camera, request.view.width, request.view.height, request.view.window()};
  Settings settings = choose_settings(shown.scene(), request);
  LitLook lit = picture_look(request, shown, camera, settings);
  const Look& look = lit.look;
  const bool denoise = request.output.denoise;
  settings.aov = settings.aov || denoise;
  settings.estimate_error = settings.estimate_error || denoise || request.output.despeckle;
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
    render_samples(request, shown, look, view, settings, progress, stopped, made);
  }
  if (made.samples_missing > 0) return made;
  if (request.output.despeckle) made.image = without_sparks(std::move(made.image));
  if (!denoise) return made;
  Stopwatch watch;
  made.denoiser = remove_noise(shown.tracer(), look, view, settings, made.image);
  made.denoise_ms = watch.lap_ms();
  return made;
}

/// Lines of a sheet's part, for which more of the sheet is seen than the part.
void draw_lines(const Request& request, SceneOnDevice& shown, const Camera& camera, const PixelWindow& part,
                Image& image) {
  const Sheet& sheet = *request.view.made_sheet;
  const PixelWindow window = ink_window(sheet, part);
  if (window == part && !image.aov.empty()) return draw_ink(sheet, {window, image.aov}, part, image);
  const std::vector<AovPixel> aov = shown.tracer().trace_aov(
      shown.look(), {camera, sheet.width, sheet.height, window}, choose_settings(shown.scene(), request));
  draw_ink(sheet, {window, aov}, part, image);
}

}  // namespace

MadePicture make_picture(const Request& request, SceneOnDevice& shown, const Camera& camera,
                         const Tracer::Progress& progress, Stopped stopped) {
  if (!request.view.made_sheet) return traced_picture(request, shown, camera, progress, stopped);
  const Sheet& sheet = *request.view.made_sheet;
  const PixelWindow window = request.view.made();
  MadePicture made;
  if (request.view.xray) {
    made.devices = device_text(shown.device());
    const Scene& scene = shown.scene();
    made.image = xray_image(shown.tracer(), scene.root, shown.look(), sheet, window,
                            choose_settings(scene, request), progress);
  } else {
    made = traced_picture(request, shown, camera, progress, stopped);
  }
  if (made.samples_missing > 0) return made;
  if (request.view.ink) draw_lines(request, shown, camera, window, made.image);
  draw_cut(sheet, window, made.image);
  return made;
}

double preview_exposure_ev(const Request& request, SceneOnDevice& shown, const Camera& camera) {
  constexpr std::uint32_t LONGEST = 160, SAMPLES = 4;
  const std::uint32_t longest = std::max(request.view.width, request.view.height);
  const auto scaled = [&](std::uint32_t side) {
    return longest > LONGEST ? std::max(side * LONGEST / longest, 1U) : side;
  };
  const View view{camera, scaled(request.view.width), scaled(request.view.height)};
  Settings settings = choose_settings(shown.scene(), request);
  settings.samples = SAMPLES;
  settings.sample_offset = 0;
  settings.aov = settings.estimate_error = settings.counters = false;
  constexpr double MOST_STOPS = 60.0, STEPS = 100.0;
  const double ev = automatic_exposure_ev(
      shown.tracer().render(picture_look(request, shown, camera, settings).look, view, settings));
  return std::clamp(std::round(STEPS * ev) / STEPS, -MOST_STOPS, MOST_STOPS);
}

}  // namespace splatray
