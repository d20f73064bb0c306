#include "app/library/shot/lights.h"

#include <cmath>
#include <numbers>

#include "app/library/shot/resolve.h"
#include "engine/base/error.h"
#include "engine/image/view.h"

namespace splatray {
namespace {

glm::dvec3 scene_center(const Scene& scene) {
  return 0.5 * (scene.bounds_min_world + scene.bounds_max_world);
}

/// The light, as bright as it asks for or else with irradiance pi at the scene's centre.
SceneLight scene_light(const Scene& scene, const LightRequest& light) {
  const glm::dvec3 to_light = light.position - scene_center(scene);
  const double squared_distance = light.kind == LIGHT_POINT ? glm::dot(to_light, to_light) : 1.0;
  const glm::vec3 irradiance_pi(static_cast<float>(std::numbers::pi * squared_distance));
  SceneLight made{light.kind, light.position, light.power.value_or(irradiance_pi)};
  made.size = light.kind == LIGHT_DIRECTIONAL ? light.size * std::numbers::pi / 360.0 : light.size;
  return made;
}

/// The key light for LOOK_SCAN, whose sky gives most of the light: softer and weaker.
SceneLight scan_light(SceneLight key) {
  key.size = 0.12;
  key.power *= 0.5F;
  return key;
}

/// A rectangle whose width is level, facing its target.
SceneLight rectangle_light(const glm::dvec3& up, const LightRequest& light) {
  const glm::dvec3 to_target = light.target - light.position;
  const double distance_squared = glm::dot(to_target, to_target);
  const glm::dvec3 normal = to_target / std::sqrt(distance_squared);
  const glm::dvec3 level = glm::normalize(glm::cross(up_across(up, normal), normal));
  const double radiance = std::numbers::pi * distance_squared / (light.edges.x * light.edges.y);
  SceneLight made{LIGHT_RECTANGLE, light.position,
                  light.power.value_or(glm::vec3(static_cast<float>(radiance)))};
  made.edge_u = 0.5 * light.edges.x * level;
  made.edge_v = 0.5 * light.edges.y * glm::cross(normal, level);
  return made;
}

/// The lights of a scene that nothing is said of: its own, else the key light of the look, none where an environment is named.
std::vector<SceneLight> own_lights(const Scene& scene, const Request& request, const Camera& camera) {
  if (!scene.lights.empty()) return exposed_lights(scene);
  if (!request.look.environment.empty() || !scene.environment_path.empty()) return {};
  std::vector<SceneLight> lights = default_lights(scene, camera);
  if (resolve_look(scene, request) == LOOK_SCAN) lights.front() = scan_light(lights.front());
  return lights;
}

}  // namespace

std::vector<SceneLight> resolve_lights(const Scene& scene, const Request& request, const Camera& camera) {
  if (!request.look.lights) return own_lights(scene, request, camera);
  if (request.look.lights->size() > LIGHTS_MOST)
    throw Error(ExitCode::usage, "found " + std::to_string(request.look.lights->size()) +
                                     " lights in --light and --sun, expected at most " +
                                     std::to_string(LIGHTS_MOST));
  const glm::dvec3 up = request.look.up.value_or(scene.up);
  std::vector<SceneLight> lights;
  for (const LightRequest& light : *request.look.lights)
    lights.push_back(light.kind == LIGHT_RECTANGLE ? rectangle_light(up, light) : scene_light(scene, light));
  return lights;
}

LightRequest light_request(const SceneLight& light) {
  LightRequest asked{light.kind, light.position, light.power};
  asked.size = light.kind == LIGHT_DIRECTIONAL ? light.size * 360.0 / std::numbers::pi : light.size;
  if (light.kind != LIGHT_RECTANGLE) return asked;
  asked.size = 0.0;
  asked.target = light.position + glm::normalize(glm::cross(light.edge_u, light.edge_v));
  asked.edges = 2.0 * glm::dvec2(glm::length(light.edge_u), glm::length(light.edge_v));
  return asked;
}

std::vector<SceneLight> lights_of_look(std::uint32_t look, std::vector<SceneLight> lights) {
  for (SceneLight& light : lights) {
    if (look != LOOK_PAPER || light.kind != LIGHT_RECTANGLE) continue;
    light.kind = LIGHT_POINT;
    light.power *= static_cast<float>(4.0 * glm::length(glm::cross(light.edge_u, light.edge_v)));
  }
  return lights;
}

}  // namespace splatray
