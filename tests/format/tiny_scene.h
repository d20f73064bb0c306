/// A complete small scene: two objects, five references in two filled leaves, colours, normal fields, columns of each
/// type, stations, lights, camera, names.
#pragma once
#include "engine/scene/phong.h"
#include "engine/scene/scene.h"
#include "engine/scene/splat.h"

namespace splatray {

inline uvec4 tiny_splat(double x, double y, double z, std::uint32_t object) {
  return pack_splat({{x, y, z}, glm::normalize(glm::dvec3(1.0, 2.0, -2.0)), 1e6, object});
}

inline Scene tiny_scene() {
  const auto leaf = [](std::uint32_t tag, std::uint32_t address) { return tag << NODE_TAG_SHIFT | address; };
  Scene scene;
  scene.root = {{10.0, -20.0, 30.0}, 0.5};
  scene.build = {3, Insertion::probe, 16, RadiusRule::knn, 1.25, 7, 11, true};
  scene.node_pool = {leaf(NODE_INNER, 1), leaf(NODE_FILLED, 0)};
  scene.node_pool.edit().resize(9, leaf(NODE_EMPTY, 0));
  scene.node_pool.edit()[8] = leaf(NODE_FILLED, 1);
  scene.begin_end = {0, 2, 5};
  scene.slab_pool = {SLAB_FULL, SLAB_FULL};
  scene.reference_pool = {0, 1, 1, 2, 3};
  scene.data_pool = {tiny_splat(5000, 6000, 7000, 0), tiny_splat(1048000, 1048000, 1048000, 1),
                     tiny_splat(1100000, 1200000, 1300000, 0), tiny_splat(2000000, 2000000, 2000000, 1)};
  scene.color_pool = {0xFF000001, 0xFF000002, 0xFF000004, 0xFF000005};
  scene.field_pool = {FIELD_FLAT, FIELD_FLAT + 1, FIELD_FLAT + 2, FIELD_FLAT - 3};
  scene.clip_pool = {CLIP_NONE, 0xFF0012A5, 0x7F407FC0, CLIP_NONE};
  scene.columns = {{"intensity", std::vector<std::uint16_t>{7, 300, 0, 65535}},
                   {"class", std::vector<std::uint8_t>{2, 6, 18, 255}},
                   {"confidence", std::vector<float>{0.5F, -1.0F, 0.0F, 1e30F}},
                   {"time", std::vector<double>{1e9 + 1e-6, 0.0, -1.0, 1e-300}}};
  scene.stations = {{"door", glm::dvec3(1.5, -2.5, 3.5), 2, 3}, {"", std::nullopt, 0, 0}};
  Material glass{};
  glass.phong.tint = vec3(0.5F, 0.25F, 1.0F);
  glass.phong.shininess = 1.0F;
  glass.ior = 1.5F;
  glass.flags = MATERIAL_DIELECTRIC;
  Material matte{};
  matte.phong.diffuse = vec3(0.75F);
  matte.phong.shininess = 32.0F;
  matte.ior = 1.0F;
  matte.flags = MATERIAL_TWO_SIDED;
  follow_phong(glass);
  follow_phong(matte);
  glass.base = glass.phong.tint;
  matte.emission = vec3(2.0F, 1.5F, 1.0F);
  scene.materials = {glass, matte};
  scene.object_names = {"glass", ""};
  scene.lights = {{LIGHT_POINT, {1.0, 2.0, 3.0}, vec3(4.0F, 5.0F, 6.0F)}};
  scene.camera = Camera{{1.0, 2.0, 3.0}, {4.0, 5.0, 6.0}, {0.0, 0.0, 1.0}, 35.0, 0.0};
  scene.up = {0.0, 0.0, 1.0};
  scene.bounds_min_world = {1.0, 2.0, 3.0};
  scene.bounds_max_world = {4.0, 5.0, 6.0};
  scene.surface_area_world = 12.5;
  scene.environment_path = "sky.hdr";
  return scene;
}

}  // namespace splatray
