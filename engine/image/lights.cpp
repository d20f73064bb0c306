#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/image/view.h"

namespace splatray {
namespace {

using std::numbers::pi;

/// Brightest channel of the irradiance that the lights together give a surface at `position` facing each of
/// them.
double summed_irradiance(const std::vector<SceneLight>& lights, const glm::dvec3& position) {
  glm::dvec3 sum(0.0);
  for (const SceneLight& light : lights) {
    const glm::dvec3 to_light = light.position - position;
    sum += glm::dvec3(light.power) / (light.kind == LIGHT_POINT ? glm::dot(to_light, to_light) : 1.0);
  }
  return std::max({sum.x, sum.y, sum.z});
}

}  // namespace

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

std::vector<SceneLight> exposed_lights(const Scene& scene) {
  std::vector<SceneLight> lights = scene.lights;
  const double irradiance =
      summed_irradiance(lights, 0.5 * (scene.bounds_min_world + scene.bounds_max_world));
  if (!std::isfinite(irradiance) || irradiance <= 0.0) return lights;
  if (irradiance >= 0.1 * pi && irradiance <= 10.0 * pi) return lights;
  for (SceneLight& light : lights) light.power *= static_cast<float>(pi / irradiance);
  return lights;
}

std::vector<Light> lights_in_root(const Scene& scene, const std::vector<SceneLight>& lights) {
  std::vector<Light> in_root;
  in_root.reserve(lights.size());
  const double unit = scene.root.unit_world;
  for (const SceneLight& light : lights) {
    const bool point = light.kind == LIGHT_POINT;
    const glm::dvec3 position = point ? scene.root.to_root(light.position) : glm::normalize(light.position);
    const glm::dvec3 power = glm::dvec3(light.power) / (point ? unit * unit : 1.0);
    in_root.push_back({glm::vec3(position), light.kind, glm::vec3(power), 0.0F});
  }
  return in_root;
}

}  // namespace splatray
