#include "tests/gpu/small_scene.h"

#include <cmath>

#include "engine/scene/phong.h"
#include "engine/scene/splat.h"

namespace splatray {

Scene disc_scene(std::uint32_t objects) {
  Scene scene;
  scene.root.unit_world = ROOT_EDGE_WORLD / (1U << LATTICE_BITS);
  scene.root.origin_world = glm::dvec3(-0.5 * ROOT_EDGE_WORLD);
  scene.bounds_min_world = glm::dvec3(-DISC_RADIUS_WORLD);
  scene.bounds_max_world = glm::dvec3(DISC_RADIUS_WORLD);
  const double radius = DISC_RADIUS_WORLD / scene.root.unit_world;
  Material matte{};
  matte.phong.diffuse = glm::vec3(1.0F);
  matte.phong.shininess = 1.0F;
  matte.ior = 1.0F;
  follow_phong(matte);
  for (std::uint32_t i = 0; i < objects; ++i) {
    const glm::dvec3 center = glm::round(scene.root.to_root({0.0, 0.0, -0.2 * i}));
    scene.data_pool.edit().push_back(pack_splat({center, {0.0, 0.0, 1.0}, radius * radius, i}));
    scene.reference_pool.edit().push_back(i);
    scene.materials.push_back(matte);
    scene.object_names.push_back("disc");
  }
  scene.node_pool = {NODE_FILLED << NODE_TAG_SHIFT};
  scene.begin_end = {0, objects};
  scene.slab_pool = {SLAB_FULL};
  scene.lights = {{LIGHT_DIRECTIONAL, {0.0, 0.0, 1.0}, glm::vec3(3.0F)}};
  return scene;
}

View disc_view(std::uint32_t width, std::uint32_t height) {
  View view;
  view.camera.eye = {0.0, 0.0, 3.0};
  view.camera.ortho_height = 2.0;
  view.width = width;
  view.height = height;
  return view;
}

Settings plain_settings() {
  Settings settings;
  settings.samples = 1;
  settings.shadows = false;
  return settings;
}

Coverage disc_coverage(const View& view, std::uint32_t x, std::uint32_t y) {
  constexpr double RIM_WORLD = 1e-3;
  const double pixel_world = view.camera.ortho_height / view.height;
  const double distance_world =
      pixel_world * std::hypot(x + 0.5 - 0.5 * view.width, y + 0.5 - 0.5 * view.height);
  if (distance_world < DISC_RADIUS_WORLD - RIM_WORLD) return Coverage::inside;
  if (distance_world > DISC_RADIUS_WORLD + RIM_WORLD) return Coverage::outside;
  return Coverage::rim;
}

}  // namespace splatray
