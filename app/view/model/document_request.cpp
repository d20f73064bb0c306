#include "app/view/model/document_request.h"

#include <algorithm>

#include "app/library/request/daylight_text.h"
#include "app/library/shot/lights.h"
#include "app/library/shot/resolve.h"

namespace splatray {
namespace {

/// The same scene's source, its files named by plain paths.
Request::Source plain(Request::Source source) {
  for (std::vector<std::filesystem::path>* paths : {&source.inputs, &source.data_paths})
    for (std::filesystem::path& path : *paths) path = plain_path(path);
  return source;
}

/// What a shot shows of the scene of `loaded`, but for the camera, the objects and what is of files.
Request shown_request(const Scene& scene, const Request& loaded, const Shot& shot) {
  const Request& asked = shot.request;
  Request shown{loaded.source, asked.look, {}, asked.settings, {}};
  shown.view.look_in = shot.settings.cutaway;
  shown.view.region = asked.view.region;
  shown.view.aperture_world = asked.view.aperture_world;
  shown.settings.error_goal = shown.settings.seconds_goal = 0.0;
  shown.settings.device.clear();
  shown.settings.cache.clear();
  Request::Look& look = shown.look;
  look.style = shot.settings.look;
  look.material = loaded.look.material;
  look.objects.clear();
  look.lights = requested_lights(resolve_lights(scene, asked, shot.view.camera));
  look.environment = shot.environment;
  look.up = asked.look.up.value_or(scene.up);
  look.tone = resolve_tone(asked);
  look.exposure_auto = false;
  return shown;
}

/// The document of the scene as a shot shows it.
Document shown_in(const Scene& scene, const Document& document, const Shot& shot) {
  const Request::Look& look = shot.request.look;
  static_cast<void>(color_by(scene, look.attributes));  // throws where the scene does not have it
  Document shown = document;
  shown.request = shown_request(scene, document.loaded->asked, shot);
  shown.camera = shot.view.camera;
  shown.camera.panorama = false;  // windows look ahead; what is written may be one
  shown.materials = document.loaded->materials;
  apply_object_changes(look.objects, scene.object_names, shown.materials);
  shown.bounds_min_world = scene.bounds_min_world;
  shown.bounds_max_world = scene.bounds_max_world;
  return shown;
}

}  // namespace

std::vector<LightRequest> requested_lights(const std::vector<SceneLight>& lights) {
  std::vector<LightRequest> asked;
  for (const SceneLight& light : lights) asked.push_back({light, {}, /*has_power=*/true});
  return asked;
}

Request request_of(const Document& document, std::uint32_t width, std::uint32_t height) {
  Request request = document.request;
  request.view.width = width;
  request.view.height = height;
  set_camera(request.view, document.camera);
  request.look.objects =
      object_changes_between(document.loaded->materials, document.materials, document.loaded->object_names);
  request.look.exposure_ev.reset();
  const bool is_automatic = document.loaded->is_scan || is_daylight(request.look.environment);
  if (is_automatic || exposure_of(document) != 0.0) request.look.exposure_ev = exposure_of(document);
  return request;
}

Request saved_request(const Document& document, const Request& asked) {
  Request saved = request_of(document, asked.view.width, asked.view.height);
  saved.output = asked.output;
  if (asked.view.sheet) {
    saved.view = document.request.view;  // a drawing places its camera by itself
    saved.view.sheet = asked.view.sheet;
    saved.view.ink = asked.view.ink;
    saved.view.xray = asked.view.xray;
    // The light over the shoulder of who looked at the scene first is not that of who looks at the sheet.
    const Request::Look& first = document.loaded->first.look;
    if (!document.loaded->asked.look.lights && saved.look.lights == first.lights && saved.look.up == first.up)
      saved.look.lights.reset();
  }
  if (asked.view.panorama) {
    Camera around = document.camera;
    around.panorama = true;
    set_camera(saved.view, around);
    saved.view.aperture_world = 0.0;
  }
  saved.view.crop = asked.view.crop;
  saved.view.tile = asked.view.tile;
  saved.view.tiles = asked.view.tiles;
  Request::Settings& settings = saved.settings;
  settings.samples = asked.settings.samples;
  settings.sample_offset = asked.settings.sample_offset;
  settings.error_goal = asked.settings.error_goal;
  settings.seconds_goal = asked.settings.seconds_goal;
  settings.aov = asked.settings.aov;
  settings.estimate_error = asked.settings.estimate_error;
  return saved;
}

Document first_document(const Scene& scene, const SceneFacts& facts, const Request& asked) {
  return first_document(scene, facts, asked, resolve(asked, scene, facts));
}

Document first_document(const Scene& scene, const SceneFacts& facts, const Request& asked, const Shot& shot) {
  Document document;
  document.loaded = std::make_shared<const LoadedPart>(
      LoadedPart{asked, shown_request(scene, asked, shot), facts, scene.object_names, scene.materials,
                 color_sources(scene), categories_of(scene, COLUMN_CLASS), categories_of(scene, COLUMN_SCAN),
                 scene.crs, !scene.stations.empty(), shot.exposes});
  return shown_in(scene, document, shot);
}

bool is_of_scene(const Document& document, const Request& request) {
  const Request& asked = document.loaded->asked;
  if (plain(request.source) != plain(asked.source) || request.look.material != asked.look.material)
    return false;
  // The scene has the up direction of its loading, which cameras and lights follow where none are given.
  return request.look.up == asked.look.up || (request.look.up && request.view.eye && request.look.lights);
}

Document shown_as(const Scene& scene, const Document& document, const Request& asked) {
  return shown_in(scene, document, resolve(asked, scene, document.loaded->facts));
}

void show_light_at_camera(const SceneLight& light, Document& document) {
  LoadedPart loaded = *document.loaded;
  loaded.first.look.lights = document.request.look.lights = requested_lights({light});
  document.loaded = std::make_shared<const LoadedPart>(std::move(loaded));
}

void show_environment(const std::string& environment, Document& document) {
  document.request.look.environment = environment;
  const LoadedPart& loaded = *document.loaded;
  std::optional<glm::vec3>& background = document.request.settings.background;
  if (background == loaded.first.settings.background) background = loaded.asked.settings.background;
}

Request kept_request(const Document& document) {
  const LoadedPart& loaded = *document.loaded;
  Request kept;
  kept.settings = document.request.settings;
  kept.settings.asked_delta_world.reset();
  // What was chosen for one scene is chosen anew for the next.
  const Settings &shown = document.request.settings, &chosen = loaded.first.settings;
  if (shown.background == chosen.background) kept.settings.background = loaded.asked.settings.background;
  if (shown.environment_turn == chosen.environment_turn)
    kept.settings.environment_turn = loaded.asked.settings.environment_turn;
  const Request::Look &look = document.request.look, &first = loaded.first.look;
  if (loaded.asked.look.style || look.style != first.style) kept.look.style = look.style;
  if (loaded.asked.look.tone || look.tone != first.tone) kept.look.tone = look.tone;
  return kept;
}

Request request_with(const Document& document, const SceneFiles& more) {
  Request request = request_of(document, 1, 1);
  const LoadedPart& loaded = *document.loaded;
  std::vector<std::string> names = loaded.object_names;
  for (const std::filesystem::path& file : more) {
    request.source.inputs.push_back(file);
    std::replace(names.begin(), names.end(), file.stem().string(), std::string());  // no longer one object's
  }
  request.look.objects = object_changes_between(loaded.materials, document.materials, names);
  return request;
}

}  // namespace splatray
