#include "engine/image/look.h"

#include "engine/scene/surface.h"

namespace splatray {
namespace {

/// What of an object find_emitters() looks at.
vec3 shown_emission(const ObjectLooks& objects, std::size_t i) {
  return (objects.materials[i].flags & MATERIAL_HIDDEN) != 0 ? vec3(0.0F) : objects.surfaces[i].emission;
}

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
