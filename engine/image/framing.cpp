#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "engine/image/view.h"
#include "engine/scene/splat.h"

namespace splatray {
namespace {

constexpr double DEG = std::numbers::pi / 180.0;
constexpr double OBLIQUE_DEG = 35.0;   ///< elevation of a look at terrain
constexpr double STEEPEST_DEG = 89.9;  ///< beyond it the scene's up tells no picture's top
constexpr double OUTERMOST = 0.01;     ///< share of the points that a robust size leaves out at each end
constexpr double FLAT = 0.3;        ///< height over width below which a scan is looked at from further above
constexpr double EYE_SHARE = 0.45;  ///< height of the eye inside, over the scan's height
/// Of the diagonal: an eye that near the middle looks along the longer side.
constexpr double CENTRAL = 0.05;
constexpr std::size_t SECTORS = 36;      ///< of directions around a scanner
constexpr double OVERHEAD_SHARE = 0.05;  ///< of points more than 45 degrees above a scanner that is indoors
constexpr double MARGIN = 1.06;          ///< picture size / size of the scene in it
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

/// The scene's size along right, up and front, without the outermost points.
glm::dvec3 robust_size(const std::vector<glm::dvec3>& points, const glm::dmat3& axes) {
  glm::dvec3 size(0.0);
  std::vector<double> along(points.size());
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < points.size(); ++i) along[i] = glm::dot(points[i], axes[axis]);
    const auto at = [&along](double share) {
      const auto place = along.begin() + std::lround(share * static_cast<double>(along.size() - 1));
      std::nth_element(along.begin(), place, along.end());
      return *place;
    };
    const double low = at(OUTERMOST);
    size[axis] = at(1.0 - OUTERMOST) - low;
  }
  return size;
}

/// Whether points lie on all sides of the place and above it.
bool is_within(const std::vector<glm::dvec3>& points, const glm::dvec3& place, const glm::dmat3& axes) {
  std::array<bool, SECTORS> seen{};
  std::size_t overhead = 0;
  for (const glm::dvec3& point : points) {
    const glm::dvec3 q = glm::transpose(axes) * (point - place);
    const double level = std::hypot(q.x, q.z);
    if (q.y > level) ++overhead;
    const double turn = (std::atan2(q.z, q.x) / std::numbers::pi + 1.0) / 2.0;
    seen[std::min(static_cast<std::size_t>(turn * SECTORS), SECTORS - 1)] = true;
  }
  const bool around = std::count(seen.begin(), seen.end(), true) >= std::ptrdiff_t(SECTORS) * 9 / 10;
  return around && static_cast<double>(overhead) > OVERHEAD_SHARE * static_cast<double>(points.size());
}

std::optional<glm::dvec3> first_sensor(const Scene& scene) {
  for (const Station& station : scene.stations)
    if (station.sensor_world) return station.sensor_world;
  return {};
}

Camera camera_inside(const Scene& scene, double fov_y_deg) {
  const std::vector<glm::dvec3> points = framed_points(scene);
  const glm::dmat3 axes = upright_axes(scene.up);
  const glm::dvec3 center = 0.5 * (scene.bounds_min_world + scene.bounds_max_world);
  const glm::dvec3 size = robust_size(points, axes);
  Camera camera;
  camera.eye = first_sensor(scene).value_or(center - (0.5 - EYE_SHARE) * size.y * axes[1]);
  glm::dvec3 middle(0.0);
  for (const glm::dvec3& point : points) middle += point / static_cast<double>(points.size());
  glm::dvec3 ahead = middle - camera.eye;
  ahead -= glm::dot(ahead, axes[1]) * axes[1];
  if (glm::length(ahead) < CENTRAL * scene.diagonal_world()) ahead = size.x > size.z ? axes[0] : -axes[2];
  const double distance = 0.5 * std::max({size.x, size.z, scene.root.unit_world});
  camera.target = camera.eye + distance * glm::normalize(ahead);
  camera.up = axes[1];
  camera.fov_y_deg = fov_y_deg;
  return camera;
}

}  // namespace

Viewpoint choose_viewpoint(const Scene& scene) {
  if (scene.stations.empty() || scene.data_pool.empty()) return Viewpoint::front;
  const std::vector<glm::dvec3> points = framed_points(scene);
  const glm::dmat3 axes = upright_axes(scene.up);
  const auto sensor = first_sensor(scene);
  if (sensor && is_within(points, *sensor, axes)) return Viewpoint::inside;
  const glm::dvec3 size = robust_size(points, axes);
  return size.y < FLAT * std::min(size.x, size.z) ? Viewpoint::oblique : Viewpoint::front;
}

const char* viewpoint_name(Viewpoint viewpoint) {
  static constexpr std::array NAMES = {"auto", "front", "oblique", "top", "inside"};
  return NAMES[static_cast<std::size_t>(viewpoint)];
}

Camera viewpoint_camera(const Scene& scene, Viewpoint viewpoint, double aspect,
                        std::optional<double> fov_y_deg) {
  const double fov = fov_y_deg.value_or(DEFAULT_FOV_Y_DEG);
  const glm::dmat3 axes = upright_axes(scene.up);
  switch (viewpoint == Viewpoint::automatic ? choose_viewpoint(scene) : viewpoint) {
    case Viewpoint::oblique:
      return angled_camera(scene, aspect, fov, DEFAULT_AZIMUTH_DEG, OBLIQUE_DEG);
    case Viewpoint::top:
      return framing_camera(scene, aspect, fov, {axes[0], -axes[2], axes[1]});
    case Viewpoint::inside:
      return camera_inside(scene, fov_y_deg.value_or(INSIDE_FOV_Y_DEG));
    case Viewpoint::automatic:
    case Viewpoint::front:
      break;
  }
  return framing_camera(scene, aspect, fov);
}

Camera default_camera(const Scene& scene, double aspect) {
  return scene.camera ? *scene.camera : framing_camera(scene, aspect);
}

Camera framing_camera(const Scene& scene, double aspect, double fov_y_deg) {
  return angled_camera(scene, aspect, fov_y_deg, DEFAULT_AZIMUTH_DEG, DEFAULT_ELEVATION_DEG);
}

Camera angled_camera(const Scene& scene, double aspect, double fov_y_deg, double azimuth_deg,
                     double elevation_deg) {
  const glm::dmat3 axes = upright_axes(scene.up);
  const double azimuth = azimuth_deg * DEG, elevation = elevation_deg * DEG;
  const glm::dvec3 level = std::cos(azimuth) * axes[2] + std::sin(azimuth) * axes[0];
  const glm::dvec3 back = std::cos(elevation) * level + std::sin(elevation) * axes[1];
  const bool steep = std::abs(elevation_deg) > STEEPEST_DEG;
  const glm::dvec3 right = glm::normalize(glm::cross(axes[1], steep ? level : back));
  Camera camera = framing_camera(scene, aspect, fov_y_deg, {right, glm::cross(back, right), back});
  if (!steep) camera.up = axes[1];
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
