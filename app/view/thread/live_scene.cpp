#include "app/view/thread/live_scene.h"

#include "app/library/picture/scene_source.h"

namespace splatray {
namespace {

/// So that back faces are seen too.
ObjectLooks two_sided(ObjectLooks looks) {
  for (Material& material : looks.materials)
    material.flags = (material.flags & MATERIAL_HIDDEN) | MATERIAL_TWO_SIDED;
  return looks;
}

}  // namespace

void LiveScene::open(SharedScene scene) {
  scene_.reset();
  tracer_.upload(*scene);
  scene_ = std::move(scene);
  look_.objects = {};
  attributes_ = {};
  legend_ = {};
}

void LiveScene::match(const Document& document, ViewMode mode) {
  match_attributes(document.attributes);
  show_objects(*scene_, mode == ViewMode::facing ? two_sided(document.looks) : document.looks, look_);
  look_.lights = document.lights;
  look_.up = document.up;
  match_environment(document.environment);
}

/// The scene is uploaded again with other colours and radii: those of a copy that lives as long as that takes.
void LiveScene::match_attributes(const AttributeOptions& attributes) {
  if (attributes == attributes_) return;
  Scene shown = *scene_;
  legend_ = show_attributes(shown, attributes);
  attributes_ = attributes;
  tracer_.upload_and_free(shown);
}

void LiveScene::match_environment(const std::string& name) {
  if (environment_ == name) return;
  environment_ = name;
  look_.environment = std::make_shared<const Environment>(choose_environment(name));
}

}  // namespace splatray
