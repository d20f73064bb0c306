#include "engine/image/look.h"

#include "engine/scene/surface.h"

namespace splatray {
namespace {

bool same_emission(const ObjectLooks& a, const ObjectLooks& b) {
  if (a.surfaces.size() != b.surfaces.size()) return false;
  for (std::size_t i = 0; i < a.surfaces.size(); ++i)
    if (shown_emission(a, i) != shown_emission(b, i)) return false;
  return true;
}

}  // namespace

Look look_of(const Scene& scene) {
  Look look{.objects = {}, .lights = scene.lights, .emitters = {}, .environment = {}, .up = scene.up};
  show_objects(scene, {scene.materials, surfaces_of(scene)}, look);
  return look;
}

void show_objects(const Scene& scene, ObjectLooks objects, Look& look) {
  if (!same_emission(objects, look.objects)) look.emitters = find_emitters(scene, objects);
  look.objects = std::move(objects);
}

}  // namespace splatray
