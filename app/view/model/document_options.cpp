#include "app/view/model/document_options.h"

#include "app/library/scene_source.h"
#include "engine/scene/surface.h"

namespace splatray {

RenderOptions render_options(const Document& document, std::uint32_t width, std::uint32_t height) {
  RenderOptions options;
  options.scene = document.loaded->source;
  options.exposure_ev = document.exposure_ev;
  PictureOptions& picture = options.picture;
  picture.width = width;
  picture.height = height;
  picture.settings = document.settings;
  picture.look = document.settings.look;
  picture.tone = document.tone;
  picture.aperture_world = 2.0 * document.settings.lens_radius_world;
  if (document.settings.side == SIDE_DELTA) picture.delta_world = document.settings.delta_world;
  set_camera(picture, document.camera);
  picture.up = document.up;
  picture.environment = document.environment;
  picture.attributes = document.attributes;
  picture.objects =
      object_options_between(document.loaded->looks, document.looks, document.loaded->object_names);
  std::vector<LightOptions>& lights = picture.lights.emplace();
  for (const SceneLight& light : document.lights) lights.push_back(light_options(light));
  return options;
}

Document first_document(const LoadedScene& loaded, const SceneOptions& options,
                        const PictureOptions& picture) {
  const Scene& scene = loaded.scene;
  Document document;
  document.loaded = std::make_shared<const LoadedPart>(LoadedPart{options,
                                                                  scene.object_names,
                                                                  {scene.materials, surfaces_of(scene)},
                                                                  color_sources(scene),
                                                                  categories_of(scene, COLUMN_CLASS),
                                                                  categories_of(scene, COLUMN_SCAN)});
  document.looks = document.loaded->looks;
  apply_object_options(picture.objects, scene.object_names, document.looks);
  document.camera = choose_camera(scene, picture);
  document.lights = choose_lights(loaded, picture, document.camera);
  document.environment = loaded.environment_name;
  document.settings = choose_settings(scene, picture);
  document.tone = choose_tone(picture);
  static_cast<void>(color_by(scene, picture.attributes));  // throws where the scene does not have it
  document.attributes = picture.attributes;
  document.up = scene.up;
  document.bounds_min_world = scene.bounds_min_world;
  document.bounds_max_world = scene.bounds_max_world;
  return document;
}

}  // namespace splatray
