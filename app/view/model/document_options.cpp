#include "app/view/model/document_options.h"

#include <algorithm>

#include "app/library/scene_source.h"
#include "engine/scene/surface.h"

namespace splatray {
namespace {

/// The same scene's options, its files named by plain paths.
SceneOptions plain(SceneOptions scene) {
  for (std::vector<std::filesystem::path>* paths : {&scene.inputs, &scene.data_paths})
    for (std::filesystem::path& path : *paths) path = plain_path(path);
  return scene;
}

}  // namespace

RenderOptions render_options(const Document& document, std::uint32_t width, std::uint32_t height) {
  RenderOptions options;
  options.scene = document.loaded->source;
  if (document.loaded->is_scan || document.exposure_ev != 0.0) options.exposure_ev = document.exposure_ev;
  PictureOptions& picture = options.picture;
  picture.width = width;
  picture.height = height;
  picture.settings = document.settings;
  picture.look = document.settings.look;
  picture.tone = document.tone;
  picture.aperture_world = 2.0 * document.settings.lens_radius_world;
  if (document.settings.side == SIDE_DELTA) picture.delta_world = document.settings.delta_world;
  set_camera(picture, document.camera);
  if (document.settings.cutaway) picture.viewpoint = Viewpoint::dollhouse;
  picture.up = document.up;
  picture.environment = document.environment;
  picture.attributes = document.attributes;
  picture.objects =
      object_options_between(document.loaded->looks, document.looks, document.loaded->object_names);
  std::vector<LightOptions>& lights = picture.lights.emplace();
  for (const SceneLight& light : document.lights) lights.push_back(light_options(light));
  return options;
}

Document first_document(const Scene& scene, const SceneOptions& source, const PictureOptions& picture) {
  Document document;
  document.loaded = std::make_shared<const LoadedPart>(
      LoadedPart{source,
                 picture,
                 choose_look(scene, suited_picture(scene, picture).picture),
                 scene.object_names,
                 {scene.materials, surfaces_of(scene)},
                 color_sources(scene),
                 categories_of(scene, COLUMN_CLASS),
                 categories_of(scene, COLUMN_SCAN),
                 !scene.stations.empty()});
  return shown_as(scene, document, picture);
}

bool is_of_scene(const Document& document, const RenderOptions& options) {
  const LoadedPart& loaded = *document.loaded;
  if (plain(options.scene) != plain(loaded.source)) return false;
  // The scene has the up direction of its loading, which cameras and lights follow that are not told.
  const PictureOptions& picture = options.picture;
  return picture.up == loaded.asked.up || (picture.up && picture.eye && picture.lights);
}

Document shown_as(const Scene& scene, const Document& document, const PictureOptions& asked) {
  const PictureOptions picture = suited_picture(scene, asked).picture;
  Document shown = document;
  shown.looks = document.loaded->looks;
  apply_object_options(picture.objects, scene.object_names, shown.looks);
  shown.camera = choose_camera(scene, picture);
  shown.lights = choose_lights(scene, picture, shown.camera);
  shown.environment = choose_environment_name(scene, picture);
  shown.settings = choose_settings(scene, picture);
  shown.tone = choose_tone(picture);
  static_cast<void>(color_by(scene, picture.attributes));  // throws where the scene does not have it
  shown.attributes = picture.attributes;
  shown.up = choose_up(scene, picture);
  shown.bounds_min_world = scene.bounds_min_world;
  shown.bounds_max_world = scene.bounds_max_world;
  return shown;
}

PictureOptions kept_options(const Document& document) {
  const LoadedPart& loaded = *document.loaded;
  PictureOptions kept;
  kept.settings = document.settings;
  kept.settings.cutaway = false;
  if (loaded.asked.look || document.settings.look != loaded.look) kept.look = document.settings.look;
  if (loaded.asked.tone || document.tone != choose_tone(loaded.asked)) kept.tone = document.tone;
  return kept;
}

RenderOptions options_with(const Document& document, const SceneFiles& more) {
  RenderOptions options = render_options(document, 1, 1);
  const LoadedPart& loaded = *document.loaded;
  std::vector<std::string> names = loaded.object_names;
  for (const std::filesystem::path& file : more) {
    options.scene.inputs.push_back(file);
    std::replace(names.begin(), names.end(), file.stem().string(), std::string());  // no longer one object's
  }
  options.picture.objects = object_options_between(loaded.looks, document.looks, names);
  return options;
}

}  // namespace splatray
