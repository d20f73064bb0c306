#include "app/view/model/document_options.h"

#include "app/library/scene_source.h"

namespace splatray {

RenderOptions render_options(const Document& document, std::uint32_t width, std::uint32_t height) {
  RenderOptions options;
  options.scene = document.loaded->source;
  options.exposure_ev = document.exposure_ev;
  PictureOptions& picture = options.picture;
  picture.width = width;
  picture.height = height;
  picture.settings = document.settings;
  if (document.settings.side == SIDE_DELTA) picture.delta_world = document.settings.delta_world;
  set_camera(picture, document.camera);
  picture.up = document.up;
  picture.environment = document.environment;
  picture.attributes = document.attributes;
  picture.objects =
      object_options_between(document.loaded->materials, document.materials, document.loaded->object_names);
  std::vector<LightOptions>& lights = picture.lights.emplace();
  for (const SceneLight& light : document.lights) lights.push_back({light.kind, light.position, light.power});
  return options;
}

Document first_document(const LoadedScene& loaded, const SceneOptions& options,
                        const PictureOptions& picture) {
  const Scene& scene = loaded.scene;
  Document document;
  document.loaded = std::make_shared<const LoadedPart>(
      LoadedPart{options, scene.object_names, scene.materials, color_sources(scene),
                 categories_of(scene, COLUMN_CLASS), categories_of(scene, COLUMN_SCAN)});
  document.materials = scene.materials;
  apply_object_options(picture.objects, scene.object_names, document.materials);
  document.camera = choose_camera(scene, picture);
  document.lights = choose_lights(loaded, picture, document.camera);
  document.environment = loaded.environment_name;
  document.settings = choose_settings(scene, picture);
  static_cast<void>(color_by(scene, picture.attributes));  // throws where the scene does not have it
  document.attributes = picture.attributes;
  document.up = scene.up;
  document.bounds_min_world = scene.bounds_min_world;
  document.bounds_max_world = scene.bounds_max_world;
  return document;
}

}  // namespace splatray
