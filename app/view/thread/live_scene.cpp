#include "app/view/thread/live_scene.h"

#include "app/library/shot/lights.h"
#include "app/library/shot/picture_lights.h"
#include "app/library/shot/resolve.h"
#include "app/view/model/document_request.h"

namespace splatray {
namespace {

/// So that back faces are seen too.
std::vector<Material> two_sided(std::vector<Material> materials) {
  for (Material& material : materials)
    material.flags = (material.flags & MATERIAL_HIDDEN) | MATERIAL_TWO_SIDED;
  return materials;
}

}  // namespace

void LiveScene::open(SharedScene scene, const AttributeOptions& attributes, const Tracer::Planned& planned) {
  attributes_ = {};
  up_ = scene->up;
  legend_ = {};
  scene_ = std::move(scene);
  try {
    if (attributes == AttributeOptions{}) {
      shown_.open(*scene_, nullptr, planned);
    } else {
      Scene copy = shown_with(*scene_, attributes);
      shown_.open(*scene_, &copy, planned);
    }
  } catch (...) {
    scene_.reset();
    throw;
  }
}

void LiveScene::match(const Document& document, ViewMode mode) {
  match_attributes(document.request.look.attributes, up_of(document));
  match_look(document, mode);
}

void LiveScene::match_look(const Document& document, ViewMode mode) {
  shown_.show_materials(mode == ViewMode::facing ? two_sided(document.materials) : document.materials);
  shown_.show_lights(
      lights_of_look(look_of(document), resolve_lights(*scene_, document.request, document.camera)));
  shown_.show_up(up_of(document));
  shown_.show_environment(document.request.look.environment);
}

std::optional<SceneLight> LiveScene::light_at_camera(const Document& document, glm::uvec2 size_px) {
  match(document, ViewMode::shaded);
  Request request = request_of(document, size_px.x, size_px.y);
  request.look.lights.reset();
  return splatray::light_at_camera(resolve(request, *scene_, document.loaded->facts), shown_,
                                   document.camera);
}

double LiveScene::exposure_ev(const Document& document, glm::uvec2 size_px) {
  match(document, ViewMode::shaded);
  Shot shot = resolve(request_of(document, size_px.x, size_px.y), *scene_, document.loaded->facts);
  shot.request.output.denoise = false;  // by the program of the picture that grows, which has no base colours
  return preview_exposure_ev(shot, shown_, shot.view.camera);
}

/// The scene is uploaded again with other colours and radii: those of a copy that lives as long as that takes.
void LiveScene::match_attributes(const AttributeOptions& attributes, const glm::dvec3& up) {
  const bool higher = up != up_ && attributes.color_by.starts_with("height");
  if (attributes == attributes_ && !higher) return;
  up_ = up;
  Scene copy = shown_with(*scene_, attributes);
  shown_.replace_pools(copy);
}

Scene LiveScene::shown_with(const Scene& scene, const AttributeOptions& attributes) {
  Scene copy = scene;
  copy.up = up_;
  legend_ = show_attributes(copy, attributes);
  attributes_ = attributes;
  return copy;
}

}  // namespace splatray
