#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/image/view.h"

namespace splatray {
namespace {

using std::numbers::pi;

glm::dvec3 bounds_center(const Scene& scene) {
  return 0.5 * (scene.bounds_min_world + scene.bounds_max_world);
}

/// What is left of a point light's intensity (shaders/light/falloff.glsl).
double falloff(const SceneLight& light, const glm::dvec3& to_light, double distance_squared) {
  double left = 1.0;
  if (light.range > 0.0) {
    const double share = distance_squared / (light.range * light.range);
    left = std::clamp(1.0 - share * share, 0.0, 1.0);
  }
  if (!is_spot(light)) return left;
  const double cosine = -glm::dot(glm::normalize(light.spot_axis), to_light) / std::sqrt(distance_squared);
  const double outer = std::cos(light.spot_outer);
  const double cone = std::clamp((cosine - outer) / (std::cos(light.spot_inner) - outer), 0.0, 1.0);
  return left * cone * cone;
}

/// Irradiance of a surface at `position` that faces the light, for flat lights as if all of them were in their centre.
glm::dvec3 irradiance_of(const SceneLight& light, const glm::dvec3& position) {
  const glm::dvec3 to_light = light.position - position;
  const double distance_squared = glm::dot(to_light, to_light);
  if (light.kind == LIGHT_DIRECTIONAL) return light.power;
  if (light.kind == LIGHT_POINT)
    return glm::dvec3(light.power) * (falloff(light, to_light, distance_squared) / distance_squared);
  const glm::dvec3 across = glm::cross(light.edge_u, light.edge_v);
  const double facing = std::max(-glm::dot(across, to_light), 0.0) / std::sqrt(distance_squared);
  return glm::dvec3(light.power) * (flat_area(light.kind) * facing / distance_squared);
}

/// Sum over all lights.
glm::dvec3 irradiance_of(const std::vector<SceneLight>& lights, const glm::dvec3& position) {
  glm::dvec3 sum(0.0);
  for (const SceneLight& light : lights) sum += irradiance_of(light, position);
  return sum;
}

/// Those at infinity, which are met where nothing else is, come after the others that have a size, and those without one last.
int table_order(const SceneLight& light) {
  return !is_sized(light) ? 2 : (light.kind == LIGHT_DIRECTIONAL ? 1 : 0);
}

Light light_in_root(const SceneLight& light, const RootTransform& root) {
  const bool directional = light.kind == LIGHT_DIRECTIONAL, point = light.kind == LIGHT_POINT;
  const double unit = root.unit_world;
  Light in_root{};
  in_root.position = directional ? glm::normalize(light.position) : root.to_root(light.position);
  in_root.kind = light.kind;
  in_root.power = glm::dvec3(light.power) / (point ? unit * unit : 1.0);
  in_root.size = static_cast<float>(directional ? light.size : (point ? light.size / unit : 1.0));
  in_root.edge_u = light.edge_u / unit;
  in_root.edge_v = light.edge_v / unit;
  const double range = light.range / unit;
  if (range > 0.0) in_root.range_scale = static_cast<float>(1.0 / (range * range * range * range));
  if (is_spot(light)) {
    const double outer = std::cos(light.spot_outer);
    in_root.spot_axis = glm::normalize(light.spot_axis);
    in_root.spot_cosine = static_cast<float>(outer);
    in_root.spot_scale = static_cast<float>(1.0 / std::max(std::cos(light.spot_inner) - outer, 1e-6));
  }
  return in_root;
}

}  // namespace

double summed_irradiance(const Scene& scene, const std::vector<SceneLight>& lights) {
  const glm::dvec3 sum = irradiance_of(lights, bounds_center(scene));
  return (sum.x + sum.y + sum.z) / 3.0;
}

std::vector<SceneLight> default_lights(const Scene& scene, const Camera& camera) {
  constexpr double LEFT = 35.0 * pi / 180.0, ABOVE = 45.0 * pi / 180.0;
  const glm::dmat3 axes = upright_axes(scene.up);
  const glm::dvec3 back = glm::normalize(camera.eye - camera.target);
  glm::dvec3 level = back - axes[1] * glm::dot(back, axes[1]);
  level = glm::length(level) > 1e-3 ? glm::normalize(level) : axes[2];
  const glm::dvec3 left = glm::cross(level, axes[1]);

  SceneLight key;
  key.position =
      std::cos(ABOVE) * (std::cos(LEFT) * level + std::sin(LEFT) * left) + std::sin(ABOVE) * axes[1];
  key.power = 2.0F * glm::vec3(1.0F, 0.96F, 0.9F);
  return {key};
}

double own_light_level(const Scene& scene) {
  const double nearest = 0.25 * scene.diagonal_world();
  double sum = 0.0;
  for (const SceneLight& light : scene.lights) {
    const double distance = std::max(glm::length(light.position - bounds_center(scene)), nearest);
    const double area = is_flat(light.kind)
                            ? flat_area(light.kind) * glm::length(glm::cross(light.edge_u, light.edge_v))
                            : 1.0;
    const double divisor = light.kind == LIGHT_DIRECTIONAL ? 1.0 : distance * distance;
    sum += area / divisor * (double(light.power.x) + double(light.power.y) + double(light.power.z)) / 3.0;
  }
  return sum;
}

std::vector<Light> lights_in_root(const Scene& scene, const std::vector<SceneLight>& lights) {
  std::vector<SceneLight> sorted = lights;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const SceneLight& a, const SceneLight& b) { return table_order(a) < table_order(b); });
  std::vector<Light> in_root;
  in_root.reserve(sorted.size());
  for (const SceneLight& light : sorted) in_root.push_back(light_in_root(light, scene.root));
  return in_root;
}

}  // namespace splatray
