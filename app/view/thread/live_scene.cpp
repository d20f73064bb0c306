#include "app/view/thread/live_scene.h"

#include <cstring>

#include "app/library/scene_source.h"

namespace splatray {
namespace {

/// So that back faces are seen too.
std::vector<Material> two_sided(std::vector<Material> materials) {
  for (Material& material : materials)
    material.flags = (material.flags & MATERIAL_HIDDEN) | MATERIAL_TWO_SIDED;
  return materials;
}

}  // namespace

bool same_materials(const std::vector<Material>& a, const std::vector<Material>& b) {
  if (a.size() != b.size()) return false;
  return a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(Material)) == 0;
}

void LiveScene::open(SharedScene scene) {
  scene_.reset();
  tracer_.upload(*scene);
  scene_ = std::move(scene);
  materials_ = scene_->materials;
  lights_.reset();
  up_ = scene_->up;
  attributes_ = {};
  legend_ = {};
}

void LiveScene::match(const Document& document, ViewMode mode) {
  match_attributes(document.attributes);
  match_materials(mode == ViewMode::facing ? two_sided(document.materials) : document.materials);
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

void LiveScene::match_materials(const std::vector<Material>& materials) {
  if (same_materials(materials, materials_)) return;
  tracer_.set_materials(materials);
  materials_ = materials;
}

/// The scene is uploaded again with other colours and radii: those of a copy that lives as long as that takes.
void LiveScene::match_attributes(const AttributeOptions& attributes) {
  if (attributes == attributes_) return;
  Scene shown = *scene_;
  legend_ = show_attributes(shown, attributes);
  attributes_ = attributes;
  tracer_.upload_and_free(shown);
  materials_ = scene_->materials;
  lights_.reset();
  up_ = scene_->up;
}

void LiveScene::match_environment(const std::string& name) {
  if (environment_ == name) return;
  environment_ = name;
  tracer_.set_environment(choose_environment(name));
}

}  // namespace splatray
