#include "tests/preprocess/shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include "engine/scene/phong.h"

namespace splatray::test {
namespace {

void add_sphere_point(InputObject& sphere, double z, double longitude, glm::dvec3 center) {
  const double ring = std::sqrt(1.0 - z * z);
  const glm::dvec3 normal(ring * std::cos(longitude), ring * std::sin(longitude), z);
  sphere.points.position.push_back(center + normal);
  sphere.points.normal.emplace_back(normal);
}

InputObject empty_sphere() {
  InputObject sphere;
  sphere.name = "sphere";
  sphere.oriented = true;
  sphere.surface_area = 4.0 * std::numbers::pi;
  return sphere;
}

template <typename Value>
void reorder(std::vector<Value>& values, const std::vector<std::size_t>& order) {
  if (values.empty()) return;
  std::vector<Value> ordered;
  for (const std::size_t i : order) ordered.push_back(values[i]);
  values = ordered;
}

}  // namespace

InputObject even_sphere(std::size_t count, glm::dvec3 center) {
  const double golden_angle = std::numbers::pi * (3.0 - std::sqrt(5.0));
  InputObject sphere = empty_sphere();
  for (std::size_t i = 0; i < count; ++i) {
    const auto step = static_cast<double>(i);
    add_sphere_point(sphere, 1.0 - 2.0 * (step + 0.5) / static_cast<double>(count), golden_angle * step,
                     center);
  }
  return sphere;
}

InputObject random_sphere(std::size_t count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  InputObject sphere = empty_sphere();
  for (std::size_t i = 0; i < count; ++i) {
    const double z = 1.0 - 2.0 * unit(random);
    add_sphere_point(sphere, z, 2.0 * std::numbers::pi * unit(random), glm::dvec3(0.0));
  }
  return sphere;
}

InputObject square_lattice(std::size_t side, double spacing) {
  InputObject lattice;
  lattice.name = "lattice";
  for (std::size_t i = 0; i < side * side; ++i) {
    lattice.points.position.emplace_back(spacing * static_cast<double>(i % side),
                                         spacing * static_cast<double>(i / side), 0.0);
    lattice.points.normal.emplace_back(0.0F, 0.0F, 1.0F);
  }
  return lattice;
}

Input input_of(InputObject object) {
  Input input;
  object.material = {};
  object.material.phong.diffuse = vec3(0.8F);
  object.material.phong.tint = vec3(1.0F);
  object.material.phong.shininess = 1.0F;
  object.material.ior = 1.0F;
  follow_phong(object.material);
  input.objects.push_back(std::move(object));
  return input;
}

InputObject shuffled(const InputObject& object, std::uint64_t seed) {
  std::vector<std::size_t> order(object.points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::shuffle(order.begin(), order.end(), std::mt19937_64(seed));
  InputObject result = object;
  reorder(result.points.position, order);
  reorder(result.points.normal, order);
  reorder(result.points.color, order);
  reorder(result.points.radius, order);
  return result;
}

Cloud cloud_of(InputObject object) {
  BuildStats stats;
  return make_cloud(std::move(object.points), object.oriented, false, stats);
}

}  // namespace splatray::test
