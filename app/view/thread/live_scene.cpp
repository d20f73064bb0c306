#include "app/view/thread/live_scene.h"

#include <algorithm>
#include <cstring>

#include "app/library/picture/scene_source.h"
#include "engine/scene/surface.h"

namespace splatray {
namespace {

/// So that back faces are seen too.
ObjectLooks two_sided(ObjectLooks looks) {
  for (Material& material : looks.materials)
    material.flags = (material.flags & MATERIAL_HIDDEN) | MATERIAL_TWO_SIDED;
  return looks;
}

bool same_emission(const std::vector<Surface>& a, const std::vector<Surface>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const Surface& x, const Surface& y) { return x.emission == y.emission; });
}

}  // namespace

void LiveScene::open(SharedScene scene) {
  scene_.reset();
  tracer_.upload(*scene);
  scene_ = std::move(scene);
  looks_ = {scene_->materials, surfaces_of(*scene_)};
  lights_.reset();
  up_ = scene_->up;
  attributes_ = {};
  legend_ = {};
}

void LiveScene::match(const Document& document, ViewMode mode) {
  match_attributes(document.attributes);
  match_looks(mode == ViewMode::facing ? two_sided(document.looks) : document.looks);
  if (lights_ != document.lights) {
    tracer_.set_lights(document.lights);
    lights_ = document.lights;
  }
  if (up_ != document.up) {
    tracer_.set_up(document.up);
    up_ = document.up;
  }
  match_environment(document.environment);
}

void LiveScene::match_looks(const ObjectLooks& looks) {
  if (same_looks(looks, looks_)) return;
  tracer_.set_materials(looks.materials, looks.surfaces);
  if (!same_emission(looks.surfaces, looks_.surfaces))
    tracer_.set_emitters(find_emitters(*scene_, looks.surfaces));
  looks_ = looks;
}

/// The scene is uploaded again with other colours and radii: those of a copy that lives as long as that takes.
void LiveScene::match_attributes(const AttributeOptions& attributes) {
  if (attributes == attributes_) return;
  Scene shown = *scene_;
  legend_ = show_attributes(shown, attributes);
  attributes_ = attributes;
  tracer_.upload_and_free(shown);
  looks_ = {scene_->materials, surfaces_of(*scene_)};
  lights_.reset();
  up_ = scene_->up;
}

void LiveScene::match_environment(const std::string& name) {
  if (environment_ == name) return;
  environment_ = name;
  tracer_.set_environment(choose_environment(name));
}

}  // namespace splatray
