#include "engine/image/look.h"

#include <algorithm>

namespace splatray {
namespace {

bool same_emission(const std::vector<Material>& a, const std::vector<Material>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Material& x, const Material& y) {
    return shown_emission(x) == shown_emission(y);
  });
}

}  // namespace

Look look_of(const Scene& scene) {
  Look look{.materials = {}, .lights = scene.lights, .emitters = {}, .environment = {}, .up = scene.up};
  show_materials(scene, scene.materials, look);
  return look;
}

void show_materials(const Scene& scene, std::vector<Material> materials, Look& look) {
  if (!same_emission(materials, look.materials)) look.emitters = find_emitters(scene, materials);
  look.materials = std::move(materials);
}

}  // namespace splatray
