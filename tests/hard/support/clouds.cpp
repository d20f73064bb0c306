#include "tests/hard/support/clouds.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/scene/phong.h"
#include "engine/scene/splat.h"

namespace splatray::testing {
namespace {

using glm::dvec3;

/// Half the distance, along an axis, of the two corner discs of lattice_scene whose bounds preprocess maps to
/// the root less its margins (preprocess/tree/root.cpp).
constexpr double CORNER_RADIUS = 2.0;

std::vector<Disc> corner_discs() {
  const dvec3 normal = glm::normalize(dvec3(1.0));
  const double half_disc =
      CORNER_RADIUS * (1.0 + 1.0 / 512.0) * (std::sqrt(1.0 - normal.x * normal.x) + 1e-4);
  const double edge = std::exp2(double(LATTICE_BITS));
  const double half = 0.5 * (edge - 2.0 * (ROOT_MARGIN + 3.0)) - half_disc;
  const dvec3 center(0.5 * edge);
  return {{center - half, normal, CORNER_RADIUS}, {center + half, normal, CORNER_RADIUS}};
}

}  // namespace

dvec3 random_unit(std::mt19937_64& random) {
  std::uniform_real_distribution<double> symmetric(-1.0, 1.0);
  for (;;) {
    const dvec3 point(symmetric(random), symmetric(random), symmetric(random));
    const double squared = glm::dot(point, point);
    if (squared > 1e-6 && squared <= 1.0) return point / std::sqrt(squared);
  }
}

double uniform(std::mt19937_64& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

Material mirror_material() {
  Material material = test_material(0);
  material.phong.diffuse = vec3(0.0F);
  material.phong.specular = 0.0F;
  material.phong.mirror = 1.0F;
  material.phong.tint = vec3(1.0F);
  return material;
}

Material glass_material(float ior) {
  Material material = test_material(MATERIAL_DIELECTRIC);
  material.phong.tint = vec3(1.0F);
  material.phong.specular = 0.0F;
  material.ior = ior;
  return material;
}

InputObject disc_object(const std::vector<Disc>& discs, const Material& material) {
  InputObject object;
  object.material = material;
  follow_phong(object.material);
  object.oriented = true;
  for (const Disc& disc : discs) {
    object.points.position.push_back(disc.center);
    object.points.normal.emplace_back(disc.normal);
    object.points.radius.push_back(static_cast<float>(disc.radius));
  }
  return object;
}

Scene build(const std::vector<InputObject>& objects, const BuildParams& params, BuildStats* stats) {
  Input input;
  input.objects = objects;
  BuildStats counts;
  Scene scene = build_scene(std::move(input), params, 0, counts);
  if (stats != nullptr) *stats = counts;
  return scene;
}

Scene lattice_scene(const std::vector<Disc>& discs, const Material& material, std::uint32_t leaf_size) {
  return build({disc_object(discs, material), disc_object(corner_discs(), test_material(0))},
               {.leaf_size = leaf_size, .normal_fields = false});
}

double overlap_of(const Scene& scene, double area_world) {
  double sum = 0.0;
  for (const uvec4& words : scene.data_pool) sum += unpack_splat(words).radius_squared;
  return sum * std::numbers::pi * scene.root.unit_world * scene.root.unit_world / area_world;
}

double median_radius_root(const Scene& scene) {
  std::vector<double> squared;
  for (const uvec4& words : scene.data_pool) squared.push_back(unpack_splat(words).radius_squared);
  const auto middle = squared.begin() + static_cast<std::ptrdiff_t>(squared.size() / 2);
  std::nth_element(squared.begin(), middle, squared.end());
  return std::sqrt(*middle);
}

}  // namespace splatray::testing
