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

/// Irradiance pi, of a point light at the scene's centre.
glm::vec3 default_power(const Scene& scene, const SceneLight& light) {
  const glm::dvec3 to_light = light.position - scene_center(scene);
  const double squared_distance = light.kind == LIGHT_POINT ? glm::dot(to_light, to_light) : 1.0;
  return glm::vec3(static_cast<float>(std::numbers::pi * squared_distance));
}

/// The key light for LOOK_SCAN, whose sky gives most of the light: softer and weaker, and white, as the light of the place is in the
/// points' colours. What is level or faces the viewer gets 1 of both, within 0.025 (SCAN_SKY of transport.glsl).
SceneLight scan_light(SceneLight key) {
  key.size = 0.12;
  key.power = glm::vec3(1.0F);
  return key;
}

/// A level rectangle, facing its target.
void set_edges(const glm::dvec3& up, const LevelRectangle& level, SceneLight& light) {
  const glm::dvec3 to_target = level.target - light.position;
  const glm::dvec3 normal = to_target / std::sqrt(glm::dot(to_target, to_target));
  const glm::dvec3 across = glm::normalize(glm::cross(up_across(up, normal), normal));
  light.edge_u = 0.5 * level.edges.x * across;
  light.edge_v = 0.5 * level.edges.y * glm::cross(normal, across);
}

/// That of irradiance pi where a rectangle shines, straight ahead.
glm::vec3 level_power(const LevelRectangle& level, const glm::dvec3& position) {
  const glm::dvec3 to_target = level.target - position;
  const double radiance = std::numbers::pi * glm::dot(to_target, to_target) / (level.edges.x * level.edges.y);
  return glm::vec3(static_cast<float>(radiance));
}

SceneLight resolved(const Scene& scene, const glm::dvec3& up, const LightRequest& asked) {
  SceneLight light = asked.light;
  if (asked.level) set_edges(up, *asked.level, light);
  if (!asked.has_power)
    light.power = asked.level ? level_power(*asked.level, light.position) : default_power(scene, light);
  return light;
}

/// The lights of a scene that nothing is said of: its own, else the key light of the look, none where an environment is named.
std::vector<SceneLight> own_lights(const Scene& scene, const Request& request, const Camera& camera) {
  if (!scene.lights.empty()) return scene.lights;
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
  for (const LightRequest& light : *request.look.lights) lights.push_back(resolved(scene, up, light));
  return lights;
}

std::vector<SceneLight> lights_of_look(std::uint32_t look, std::vector<SceneLight> lights) {
  for (SceneLight& light : lights) {
    if (look != LOOK_PAPER || !is_flat(light.kind)) continue;
    light.power *=
        static_cast<float>(flat_area(light.kind) * glm::length(glm::cross(light.edge_u, light.edge_v)));
    light.kind = LIGHT_POINT;
  }
  return lights;
}

}  // namespace splatray
