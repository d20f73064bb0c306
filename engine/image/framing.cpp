#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/image/view.h"
#include "engine/scene/splat.h"

namespace splatray {
namespace {

constexpr double DEG = std::numbers::pi / 180.0;
constexpr double AZIMUTH_DEG = 27.0;    ///< from the front towards the scene's right
constexpr double ELEVATION_DEG = 17.0;  ///< above the horizon
constexpr double MARGIN = 1.06;         ///< picture size / size of the scene in it
constexpr std::size_t MOST_POINTS = 1U << 16;

/// What must be in the picture, world space: an even choice of the splat centres, or the bounding box's
/// corners.
std::vector<glm::dvec3> framed_points(const Scene& scene) {
  std::vector<glm::dvec3> points;
  const std::size_t stride = scene.data_pool.size() / MOST_POINTS + 1;
  for (std::size_t i = 0; i < scene.data_pool.size(); i += stride)
    points.push_back(scene.root.to_world(unpack_splat(scene.data_pool[i]).center));
  if (!points.empty()) return points;
  for (int corner = 0; corner < 8; ++corner)
    points.push_back(glm::mix(scene.bounds_min_world, scene.bounds_max_world,
                              glm::bvec3((corner & 1) != 0, (corner & 2) != 0, (corner & 4) != 0)));
  return points;
}

/// Least distance, and the centred offset, of a pinhole of half-angle tangent `slope` that sees all points
/// along one image axis. A point at (across, towards) is seen from (offset, distance) when |across - offset|
/// <= (distance - towards) slope.
struct AxisFit {
  double slope;
  double positive = -std::numeric_limits<double>::infinity();
  double negative = positive;

  void add(double across, double towards) {
    positive = std::max(positive, towards * slope + across);
    negative = std::max(negative, towards * slope - across);
  }
  [[nodiscard]] double offset() const { return 0.5 * (positive - negative); }
  [[nodiscard]] double distance() const { return 0.5 * (positive + negative) / slope; }
};

}  // namespace

Camera default_camera(const Scene& scene, double aspect) {
  return scene.camera ? *scene.camera : framing_camera(scene, aspect);
}

Camera framing_camera(const Scene& scene, double aspect, double fov_y_deg) {
  const glm::dmat3 axes = upright_axes(scene.up);
  const glm::dvec3 level = std::cos(AZIMUTH_DEG * DEG) * axes[2] + std::sin(AZIMUTH_DEG * DEG) * axes[0];
  const glm::dvec3 back = std::cos(ELEVATION_DEG * DEG) * level + std::sin(ELEVATION_DEG * DEG) * axes[1];
  const glm::dvec3 right = glm::normalize(glm::cross(axes[1], back));
  Camera camera = framing_camera(scene, aspect, fov_y_deg, {right, glm::cross(back, right), back});
  camera.up = axes[1];
  return camera;
}

Camera framing_camera(const Scene& scene, double aspect, double fov_y_deg, const glm::dmat3& axes) {
  const glm::dvec3 center = 0.5 * (scene.bounds_min_world + scene.bounds_max_world);
  const double slope = std::tan(0.5 * fov_y_deg * DEG) / MARGIN;
  AxisFit horizontal{slope * aspect}, vertical{slope};
  for (const glm::dvec3& point : framed_points(scene)) {
    const glm::dvec3 q = point - center;
    horizontal.add(glm::dot(q, axes[0]), glm::dot(q, axes[2]));
    vertical.add(glm::dot(q, axes[1]), glm::dot(q, axes[2]));
  }
  const double least = std::max(1e-3 * scene.diagonal_world(), scene.root.unit_world);
  const double distance = std::max({horizontal.distance(), vertical.distance(), least});

  Camera camera;
  camera.target = center + horizontal.offset() * axes[0] + vertical.offset() * axes[1];
  camera.eye = camera.target + distance * axes[2];
  camera.up = axes[1];
  camera.fov_y_deg = fov_y_deg;
  return camera;
}

}  // namespace splatray
