#include "app/library/picture/make_picture.h"

#include <algorithm>
#include <utility>

#include "app/library/codec/picture_format.h"
#include "app/library/picture/denoise.h"
#include "app/library/picture/picture_file.h"
#include "app/library/picture/resume.h"
#include "app/library/picture/sheet_light.h"
#include "app/library/picture/xray.h"
#include "app/library/sheet/draw_cut.h"
#include "app/library/sheet/ink.h"
#include "app/library/sheet/seen_lines.h"
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
  const bool shows_albedo = needs(request.output.aovs, AovSource::albedo);
  if (!shot.denoises() && !shows_albedo) return made;
  Stopwatch watch;
  std::vector<vec4> base = std::exchange(made.image.albedo, {});
  if (base.empty()) base = base_colors(shown.tracer(), look, view, settings);
  if (shows_albedo) made.image.albedo = base;
  if (!shot.denoises()) return made;
  made.denoiser = remove_noise(made.image, std::move(base));
  made.denoise_ms = watch.lap_ms();
  return made;
}

/// A sheet as traced_picture gives it, its light traced in cells of several pixels.
MadePicture picture_lit_by_cells(const Shot& shot, const Sheet& sheet, std::uint32_t cell,
                                 SceneOnDevice& shown, const Tracer::Progress& progress) {
  constexpr std::uint32_t FINE_SAMPLES =
      2;                             // with the cells' light no step between two pixels is more than half
  constexpr double FINE_PART = 0.5;  // of the time
  const auto part_of = [&progress](double begin, double size) {
    return [&progress, begin, size](double done) { return !progress || progress(begin + size * done); };
  };
  const Sheet cells = sheet_of_cells(sheet, cell);
  LitLook lit = lit_look(shot, shown, shot.view.camera);
  Settings settings = shot.settings;
  settings.look = LOOK_BASE;
  settings.samples = FINE_SAMPLES;
  settings.aov = true;
  settings.estimate_error = settings.counters = false;
  Image fine = shown.tracer().render(lit.look, shot.view, settings, part_of(0.0, FINE_PART));
  const double base_ms = shown.tracer().stats().wall_ms;
  settings = shot.settings;
  settings.aov = false;
  settings.estimate_error = true;
  MadePicture made;
  made.devices = device_text(shown.device());
  made.lights = lit.look.lights.size();
  made.notes = std::move(lit.notes);
  made.image = shown.tracer().render(lit.look, {cells.camera(), cells.width, cells.height}, settings,
                                     part_of(FINE_PART, 1.0 - FINE_PART));
  made.stats = shown.tracer().stats();
  made.stats.wall_ms += base_ms;
  Stopwatch watch;
  const CellSurfaces surfaces = surfaces_of_cells(fine, cell);
  made.image.aov = surfaces.aov;
  made.denoiser = remove_noise(made.image, surfaces.base);
  light_up(sheet, cell, made.image.rgba, surfaces, fine);
  made.image = std::move(fine);
  made.denoise_ms = watch.lap_ms();
  return made;
}

/// What the rays through the centres of a sheet's pixels hit that shows what is above the cut of the shot's.
std::vector<AovPixel> overhead_aov(const Shot& shot, const Sheet& sheet, const Sheet& above,
                                   SceneOnDevice& shown) {
  Settings settings = shot.settings;
  std::vector<HalfSpace>& kept = settings.region.kept;
  kept.erase(kept.end() - static_cast<std::ptrdiff_t>(sheet.planes().size()), kept.end());
  for (const HalfSpace& plane : above.planes()) kept.push_back(plane);
  return shown.tracer().trace_aov(shown.look(), {above.camera(), above.width, above.height}, settings);
}

/// The whole sheet with the lines of what is seen on it, `aov` what its pixels show where that is known.
Sheet sheet_with_lines(const Shot& shot, const Sheet& sheet, SceneOnDevice& shown,
                       const std::vector<AovPixel>& aov) {
  Sheet drawn = sheet;
  const View view{shot.view.camera, sheet.width, sheet.height};
  drawn.beyond =
      seen_lines(sheet, aov.empty() ? shown.tracer().trace_aov(shown.look(), view, shot.settings) : aov);
  if (sheet.asked.kind != SheetKind::plan || !sheet.cuts) return drawn;
  const Sheet above = overhead_sheet(sheet);
  drawn.overhead = mirrored(seen_lines(above, overhead_aov(shot, sheet, above, shown)));
  return drawn;
}

/// Lines of a sheet's part, for which more of the sheet is seen than the part.
void draw_lines(const Shot& shot, const Sheet& sheet, SceneOnDevice& shown, const PixelWindow& part,
                Image& image) {
  const PixelWindow window = ink_window(sheet, part);
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
  if (lower_extension(shot.request.output.path) == ".dxf") {  // has no pixels
    made.sheet = sheet_with_lines(shot, *sheet, shown, {});
    return made;
  }
  if (shot.request.view.xray) {
    made.image =
        xray_image(shown.scene(), shown.look().materials, *sheet, window, shot.settings.region, progress);
  } else if (const std::uint32_t cell = light_cell(shot); cell > 1) {
    made = picture_lit_by_cells(shot, *sheet, cell, shown, progress);
  } else {
    made = traced_picture(shot, shown, camera, progress, stopped);
  }
  if (made.samples_missing > 0) return made;
  const bool is_whole = shot.view.window.width == 0;
  if (shot.request.view.ink && is_whole) made.sheet = sheet_with_lines(shot, *sheet, shown, made.image.aov);
  if (shot.request.view.ink && !is_whole) draw_lines(shot, *sheet, shown, window, made.image);
  clear_solids(*sheet, window, made.image);
  if (!is_line_format(shot.request.output.path)) draw_cut(made.sheet.value_or(*sheet), window, made.image);
  return made;
}

}  // namespace splatray
