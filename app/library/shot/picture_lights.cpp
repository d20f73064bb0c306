#include "app/library/shot/picture_lights.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "app/library/display_image.h"
#include "app/library/request/daylight_text.h"
#include "app/library/shot/lights.h"
#include "app/library/shot/picture_notes.h"
#include "app/library/user_folders.h"
#include "engine/base/number_text.h"
#include "engine/base/rank.h"
#include "engine/scene/look_style.h"

namespace splatray {
namespace {

constexpr std::size_t RAYS = 256;
constexpr std::size_t MOST_OUT = RAYS / 64;  ///< of them, from where light hardly enters

/// Rays from the eye in even directions: a Fibonacci lattice.
std::vector<RayQuery> rays_around(const Scene& scene, const glm::dvec3& eye) {
  std::vector<RayQuery> rays(RAYS);
  for (std::size_t i = 0; i < RAYS; ++i) {
    const double height = 1.0 - (2.0 * static_cast<double>(i) + 1.0) / RAYS;
    const double turn = 2.0 * std::numbers::pi * std::numbers::phi * static_cast<double>(i);
    const double level = std::sqrt(1.0 - height * height);
    rays[i].origin = scene.root.to_root(eye);
    rays[i].dir = glm::dvec3(level * std::cos(turn), level * std::sin(turn), height);
    rays[i].from_object = NO_OBJECT;
  }
  return rays;
}

/// What automatic_exposure_ev gives for a small picture in this look, at most 160 pixels wide and high.
double look_exposure_ev(const Shot& shot, SceneOnDevice& shown, const Camera& camera, const Look& look) {
  constexpr std::uint32_t LONGEST = 160, SAMPLES = 4;
  const std::uint32_t longest = std::max(shot.view.width, shot.view.height);
  const auto scaled = [&](std::uint32_t side) {
    return longest > LONGEST ? std::max(side * LONGEST / longest, 1U) : side;
  };
  const View view{camera, scaled(shot.view.width), scaled(shot.view.height)};
  Settings settings = shot.settings;
  settings.samples = SAMPLES;
  settings.sample_offset = 0;
  settings.aov = settings.estimate_error = settings.counters = false;
  settings.albedo =
      shot.traced_settings().albedo;  // by the picture's own program: another takes as long to build
  return automatic_exposure_ev(shown.tracer().render(look, view, settings));
}

/// Whether a scene may be dark inside: no light was asked for or is its own.
bool has_default_light(const Shot& shot, const SceneOnDevice& shown) {
  const Scene& scene = shown.scene();
  const Request::Look& asked = shot.request.look;
  return !asked.lights && asked.environment.empty() && scene.environment_path.empty() && scene.lights.empty();
}

/// The median distance, world units, of what the eye sees around it where next to none of the directions from it lead out of the
/// scene; else nothing.
std::optional<double> room_around(SceneOnDevice& shown, const Camera& camera, const Settings& settings) {
  const Scene& scene = shown.scene();
  const bool within = glm::all(glm::greaterThan(camera.eye, scene.bounds_min_world)) &&
                      glm::all(glm::lessThan(camera.eye, scene.bounds_max_world));
  if (!within) return {};
  std::vector<double> distances;
  for (const RayHit& hit : shown.tracer().intersect(shown.look(), rays_around(scene, camera.eye), settings))
    if (hit.object != NO_OBJECT) distances.push_back(double{hit.t} * scene.root.unit_world);
  if (distances.size() + MOST_OUT < RAYS) return {};
  return value_at(distances, 0.5);
}

/// A light at the camera in a room that the default light hardly enters: the first samples of a picture in `look` find less than a
/// quarter of the light that one needs, or of a room with objects that send out light less than a sixteenth: these are lamps that were
/// meant to light it, unless they hardly do. As bright as makes irradiance pi at the median distance of what the eye sees around it.
/// Nothing for looks that do not trace paths and for orthographic cameras.
std::optional<SceneLight> headlight(const Shot& shot, SceneOnDevice& shown, const Camera& camera,
                                    const Look& look) {
  const double dark_stops = sends_out_light(shown.look().materials) ? 4.0 : 2.0;
  if (camera.ortho_height > 0.0 || !look_style(shot.settings.look).paths || !has_default_light(shot, shown))
    return {};
  const std::optional<double> usual = room_around(shown, camera, shot.settings);
  if (!usual) return {};
  const double stops = look_exposure_ev(shot, shown, camera, look);
  if (stops != 0.0 && stops < dark_stops) return {};  // 0: all is black
  SceneLight light;
  light.kind = LIGHT_POINT;
  light.position = camera.eye;
  light.power = glm::vec3(static_cast<float>(std::numbers::pi * *usual * *usual));
  return light;
}

/// In the lights that the request asks for, or those by default.
Look plain_look(const Shot& shot, const SceneOnDevice& shown, const Camera& camera) {
  Look look = shown.look();
  look.lights = lights_of_look(shot.settings.look, resolve_lights(shown.scene(), shot.request, camera));
  return look;
}

}  // namespace

std::optional<SceneLight> light_at_camera(const Shot& shot, SceneOnDevice& shown, const Camera& camera) {
  return headlight(shot, shown, camera, plain_look(shot, shown, camera));
}

void prepare_programs(const Shot& shot, SceneOnDevice& shown) {
  if (shot.request.view.xray || shown.device().profile().slow) return;
  View view = shot.view;
  view.camera = first_camera(shot, shown.scene());
  shown.tracer().prepare(plain_look(shot, shown, view.camera), view, shot.traced_settings());
}

LitLook lit_look(const Shot& shot, SceneOnDevice& shown, const Camera& camera) {
  LitLook lit{plain_look(shot, shown, camera)};
  if (const auto at_eye = headlight(shot, shown, camera, lit.look)) {
    lit.look.lights = {*at_eye};
    lit.notes.emplace_back("no light enters where the camera is, one is put there; --light says others");
  }
  for (std::string& note : missing_light(lit.look, shot.settings)) lit.notes.push_back(std::move(note));
  return lit;
}

namespace {

/// The exposure of light in physical units that lies open: by which white sends out 1 where it faces a scene's own lights, or on level
/// ground in daylight. Nothing in other light.
std::optional<double> open_exposure_ev(const Shot& shot, const Look& look, const Scene& scene) {
  if (!scene.lights.empty() && look.lights == lights_of_look(shot.settings.look, scene.lights))
    return std::log2(std::numbers::pi / own_light_level(scene));
  if (!is_daylight(shot.environment) || !look.environment) return {};
  const auto c = irradiance_coefficients(*look.environment);
  const glm::dvec3 upwards(c[0] + c[1] - c[6] - c[8]);  // their polynomials at (0, 1, 0)
  const double bright =
      (upwards.x + upwards.y + upwards.z) / 3.0 * double(shot.settings.environment_strength);
  return std::log2(1.0 / bright);
}

}  // namespace

double preview_exposure_ev(const Shot& shot, SceneOnDevice& shown, const Camera& camera) {
  constexpr double MOST_STOPS = 60.0, STEPS = 100.0, BRIGHTER = 1.5;
  const Look look = lit_look(shot, shown, camera).look;
  double ev = look_exposure_ev(shot, shown, camera, look);
  if (const auto open = open_exposure_ev(shot, look, shown.scene()); open && std::isfinite(*open))
    ev = std::clamp(*open, ev, ev + BRIGHTER);
  return std::clamp(std::round(STEPS * ev) / STEPS, -MOST_STOPS, MOST_STOPS);
}

namespace {

/// That of the overview in the look of what is shown.
double overview_exposure_ev(const Shot& shot, const SceneOnDevice& shown, const Scene& overview) {
  SceneOnDevice whole(shown.device(), {.pipeline_folder = user_cache_folder()});
  whole.open(overview);
  whole.show_environment(shot.environment);
  whole.show_materials(shown.look().materials);
  return preview_exposure_ev(shot, whole, first_camera(shot, overview));
}

}  // namespace

void expose(Shot& shot, SceneOnDevice& shown, const SceneFacts& facts) {
  if (!shot.exposes) return;
  const double ev = facts.overview ? overview_exposure_ev(shot, shown, *facts.overview)
                                   : preview_exposure_ev(shot, shown, first_camera(shot, shown.scene()));
  shot.request.look.exposure_ev = ev;
  shot.exposes = false;
  // Behind what decides what is seen, before what is done to the picture.
  const auto noise = std::find_if(shot.choices.begin(), shot.choices.end(),
                                  [](const FieldText& choice) { return choice.name == "denoise"; });
  shot.choices.insert(noise, {"exposure", number_text(ev)});
}

}  // namespace splatray
