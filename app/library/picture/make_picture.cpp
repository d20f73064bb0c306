#include "app/library/picture/make_picture.h"

#include "app/library/picture/denoise.h"
#include "app/library/picture/scene_source.h"
#include "engine/base/stopwatch.h"

namespace splatray {
namespace {

/// Most samples of a pixel of a picture that is traced until it is good enough.
constexpr std::uint32_t GOAL_SAMPLES = 65536;

}  // namespace

MadePicture make_picture(const Request& request, const Scene& scene, const Camera& camera, Tracer& tracer,
                         const Tracer::Progress& progress) {
  const View view{camera, request.view.width, request.view.height, request.view.window()};
  const std::vector<SceneLight> lights = choose_lights(scene, request, camera);
  tracer.set_lights(lights);
  const bool denoise = request.output.denoise;
  Settings settings = choose_settings(scene, request);
  settings.aov = settings.aov || denoise;
  settings.estimate_error = settings.estimate_error || denoise;
  MadePicture made;
  made.lights = lights.size();
  if (request.settings.has_goal()) {
    settings.samples = GOAL_SAMPLES;
    Goal goal{.error = request.settings.error_goal};
    if (request.settings.seconds_goal > 0.0) goal.seconds = request.settings.seconds_goal;
    made.image = tracer.render_until(view, settings, goal, progress);
  } else {
    made.image = tracer.render(view, settings, progress);
  }
  made.stats = tracer.stats();
  if (!denoise) return made;
  Stopwatch watch;
  made.denoiser = remove_noise(tracer, view, settings, made.image);
  made.denoise_ms = watch.lap_ms();
  return made;
}

}  // namespace splatray
