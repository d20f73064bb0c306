#include "preprocess/ground.h"

#include <algorithm>
#include <limits>

#include "engine/image/view.h"
#include "engine/scene/phong.h"

namespace splatray {
namespace {

constexpr double HALF_WIDTH = 5.0, DISTANCE_BELOW = 2e-4;  ///< of the scene's diagonal
constexpr int HALF_COUNT = 8;                              ///< discs along half an edge
constexpr double RADIUS = 0.75;  ///< of their distance: more than half a square's diagonal
constexpr float GREY = 0.5F;

/// The lowest of all points along a unit direction.
double lowest_along(const std::vector<Cloud>& clouds, const glm::dvec3& up) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const Cloud& cloud : clouds)
    for (std::size_t i = 0; i < cloud.size(); ++i)
      lowest = std::min(lowest, glm::dot(cloud.place_world(i), up));
  return lowest;
}

Material ground_material() {
  Material material = default_material();
  material.phong.diffuse = glm::vec3(GREY);
  follow_phong(material);
  return material;
}

}  // namespace

void add_ground(std::vector<Cloud>& clouds, Scene& scene) {
  const glm::dmat3 axes = upright_axes(scene.up);
  const double diagonal = scene.diagonal_world() > 0.0 ? scene.diagonal_world() : 1.0;
  const glm::dvec3 middle = 0.5 * (scene.bounds_min_world + scene.bounds_max_world);
  const double height = lowest_along(clouds, axes[1]) - DISTANCE_BELOW * diagonal;
  const glm::dvec3 center = middle + (height - glm::dot(middle, axes[1])) * axes[1];
  const double step = HALF_WIDTH * diagonal / HALF_COUNT;
  Points points;
  for (int i = -HALF_COUNT; i <= HALF_COUNT; ++i)
    for (int j = -HALF_COUNT; j <= HALF_COUNT; ++j) {
      points.position.push_back(center + step * (double(i) * axes[0] + double(j) * axes[2]));
      points.normal.emplace_back(axes[1]);
      points.radius.push_back(static_cast<float>(RADIUS * step));
    }
  BuildStats of_ground;  // its points are not the input's
  clouds.push_back(make_cloud(std::move(points), /*oriented=*/true, /*measured=*/false, of_ground));
  scene.materials.push_back(ground_material());
  scene.object_names.emplace_back("ground");
  scene.surface_area_world = 0.0;  // unknown: what was measured is of the other objects
}

}  // namespace splatray
