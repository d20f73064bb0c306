#include "app/library/picture/eye_light.h"

#include <cmath>
#include <numbers>
#include <vector>

#include "app/library/picture/picture_notes.h"
#include "engine/base/rank.h"
#include "engine/scene/look_style.h"

namespace splatray {
namespace {

constexpr std::size_t RAYS = 256;
constexpr std::size_t MOST_OUT = RAYS / 64;  ///< of them, from where light hardly enters

/// Rays from the eye in even directions: a Fibonacci lattice.
std::vector<RayQuery> rays_around(const Scene& scene, const glm::dvec3& eye) {
  std::vector<RayQuery> rays(RAYS);
  for (std::size_t i = 0; i < RAYS; ++i) {
    const double height = 1.0 - (2.0 * static_cast<double>(i) + 1.0) / RAYS;
    const double turn = 2.0 * std::numbers::pi * std::numbers::phi * static_cast<double>(i);
    const double level = std::sqrt(1.0 - height * height);
    rays[i].origin = scene.root.to_root(eye);
    rays[i].dir = glm::dvec3(level * std::cos(turn), level * std::sin(turn), height);
    rays[i].from_object = NO_OBJECT;
  }
  return rays;
}

}  // namespace

std::optional<SceneLight> eye_light(SceneOnDevice& shown, const Camera& camera, const Settings& settings) {
  const Scene& scene = shown.scene();
  const bool within = glm::all(glm::greaterThan(camera.eye, scene.bounds_min_world)) &&
                      glm::all(glm::lessThan(camera.eye, scene.bounds_max_world));
  if (!within || camera.ortho_height > 0.0 || !look_style(settings.look).paths || !scene.lights.empty() ||
      sends_out_light(shown.look().objects))
    return {};
  std::vector<double> distances;
  for (const RayHit& hit : shown.tracer().intersect(shown.look(), rays_around(scene, camera.eye), settings))
    if (hit.object != NO_OBJECT) distances.push_back(double{hit.t} * scene.root.unit_world);
  if (distances.size() + MOST_OUT < RAYS) return {};
  const double usual = value_at(distances, 0.5);
  SceneLight light;
  light.kind = LIGHT_POINT;
  light.position = camera.eye;
  light.power = glm::vec3(static_cast<float>(std::numbers::pi * usual * usual));
  return light;
}

}  // namespace splatray
