#include "app/view/model/document_request.h"

#include <algorithm>

#include "app/library/shot/lights.h"
#include "app/library/shot/resolve.h"
#include "engine/scene/surface.h"

namespace splatray {
namespace {

/// The same scene's source, its files named by plain paths.
Request::Source plain(Request::Source source) {
  for (std::vector<std::filesystem::path>* paths : {&source.inputs, &source.data_paths})
    for (std::filesystem::path& path : *paths) path = plain_path(path);
  return source;
}

/// What a drawing, which places its camera by itself, has of the view shown and of the sheet asked for.
Request::View drawn_view(const Request::View& shown, const Request::View& asked) {
  Request::View drawn;
  drawn.look_in = shown.look_in;
  drawn.region = shown.region;
  drawn.aperture_world = shown.aperture_world;
  drawn.sheet = asked.sheet;
  drawn.ink = asked.ink;
  drawn.xray = asked.xray;
  return drawn;
}

/// The document of the scene as a shot shows it.
Document shown_in(const Scene& scene, const Document& document, const Shot& shot) {
  const Request& request = shot.request;
  Document shown = document;
  shown.looks = document.loaded->looks;
  apply_object_changes(request.look.objects, scene.object_names, shown.looks);
  shown.camera = shot.view.camera;
  shown.lights = resolve_lights(scene, request, shot.view.camera);
  shown.environment = shot.environment;
  shown.settings = shot.settings;
  shown.region = request.view.region;
  shown.tone = resolve_tone(request);
  static_cast<void>(color_by(scene, request.look.attributes));  // throws where the scene does not have it
  shown.attributes = request.look.attributes;
  shown.up = request.look.up.value_or(scene.up);
  shown.bounds_min_world = scene.bounds_min_world;
  shown.bounds_max_world = scene.bounds_max_world;
  return shown;
}

}  // namespace

Request request_of(const Document& document, std::uint32_t width, std::uint32_t height) {
  Request request;
  request.source = document.loaded->asked.source;
  request.view.width = width;
  request.view.height = height;
  set_camera(request.view, document.camera);
  request.view.look_in = document.settings.cutaway;
  request.view.region = document.region;
  request.view.aperture_world = 2.0 * document.settings.lens_radius_world;
  static_cast<Settings&>(request.settings) = document.settings;
  if (document.settings.side == SIDE_DELTA)
    request.settings.asked_delta_world = document.settings.delta_world;
  Request::Look& look = request.look;
  look.style = document.settings.look;
  look.material = document.loaded->asked.look.material;
  if (document.loaded->is_scan || document.exposure_ev != 0.0) look.exposure_ev = document.exposure_ev;
  look.tone = document.tone;
  look.up = document.up;
  look.environment = document.environment;
  look.attributes = document.attributes;
  look.objects =
      object_changes_between(document.loaded->looks, document.looks, document.loaded->object_names);
  std::vector<LightRequest>& lights = look.lights.emplace();
  for (const SceneLight& light : document.lights) lights.push_back({light, {}, /*has_power=*/true});
  return request;
}

Request saved_request(const Document& document, const Request& asked) {
  Request saved = request_of(document, asked.view.width, asked.view.height);
  saved.output = asked.output;
  if (asked.view.sheet) saved.view = drawn_view(saved.view, asked.view);
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
  document.loaded = std::make_shared<const LoadedPart>(LoadedPart{asked,
                                                                  facts,
                                                                  shot.settings.look,
                                                                  scene.object_names,
                                                                  {scene.materials, surfaces_of(scene)},
                                                                  color_sources(scene),
                                                                  categories_of(scene, COLUMN_CLASS),
                                                                  categories_of(scene, COLUMN_SCAN),
                                                                  scene.crs,
                                                                  !scene.stations.empty()});
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

Request kept_request(const Document& document) {
  const LoadedPart& loaded = *document.loaded;
  Request kept;
  static_cast<Settings&>(kept.settings) = document.settings;
  kept.settings.cutaway = false;
  kept.settings.region = {};
  if (loaded.asked.look.style || document.settings.look != loaded.look)
    kept.look.style = document.settings.look;
  if (loaded.asked.look.tone || document.tone != resolve_tone(loaded.asked)) kept.look.tone = document.tone;
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
  request.look.objects = object_changes_between(loaded.looks, document.looks, names);
  return request;
}

}  // namespace splatray
