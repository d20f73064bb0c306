#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "engine/base/rank.h"
#include "engine/image/framing/broad_side.h"
#include "engine/image/framing/sensor_frame.h"
#include "engine/image/point_sample.h"
#include "engine/image/scan_kind.h"
#include "engine/image/view.h"
#include "engine/image/view_check.h"

namespace splatray {
namespace {

constexpr double DEG = std::numbers::pi / 180.0;
constexpr double OBLIQUE_DEG = 35.0;   ///< elevation of a look at terrain
constexpr double STEEPEST_DEG = 89.9;  ///< beyond it the scene's up does not define a picture's top
constexpr double EYE_SHARE = 0.45;     ///< height of the eye inside, over the scan's height
/// Fraction of the diagonal: an eye that near the middle looks along the longer side.
constexpr double CENTRAL = 0.05;
constexpr double OUTERMOST = 0.01;  ///< share of the points that a robust size leaves out at each end
constexpr double MARGIN = 1.06;     ///< picture size / size of the scene in it
/// Share of a site's or room's points that its frame leaves out at each end.
constexpr double FRAME_OUTSIDE = 0.005;
constexpr double BOX_SLACK = 0.01;  ///< of the size: walls are rough
/// The same for sweeps, whose last points are far away and far apart.
constexpr double SWEEP_OUTSIDE = 0.02;
/// Where a doll's house is looked at from, degrees: from its front, left and above, as in a section of a building.
constexpr double DOLL_AZIMUTH_DEG = -32.7, DOLL_ELEVATION_DEG = 42.0, DOLL_FOV_Y_DEG = 34.0;
constexpr double SENSOR_SHARE = 0.99;  ///< of what a sensor saw

/// The share of a scan's points that its frame may leave out at each end: things are seen whole.
double outside_of(SceneKind kind) {
  if (kind == SceneKind::sweep) return SWEEP_OUTSIDE;
  return kind == SceneKind::site || kind == SceneKind::room ? FRAME_OUTSIDE : 0.0;
}

/// Without the points beyond what holds all but a share at each end, right, up and front.
PointSample within_box(const PointSample& sample, const glm::dmat3& axes, double outside) {
  glm::dvec3 low(0.0), high(0.0);
  for (int axis = 0; axis < 3; ++axis) {
    const auto [first, last] = range_along(sample.position, axes[axis], outside);
    const double slack = BOX_SLACK * (last - first);
    low[axis] = first - slack;
    high[axis] = last + slack;
  }
  PointSample kept;
  for (std::size_t i = 0; i < sample.size(); ++i) {
    const glm::dvec3 q = glm::transpose(axes) * sample.position[i];
    if (!glm::all(glm::greaterThanEqual(q, low)) || !glm::all(glm::lessThanEqual(q, high))) continue;
    kept.position.push_back(sample.position[i]);
    kept.normal.push_back(sample.normal[i]);
  }
  return kept;
}

/// What must be in the picture, world space: of scans the main parts without their outermost points, else an even choice of the
/// splat centres, or the bounding box's corners.
PointSample framed_points(const Scene& scene, const Region& region) {
  PointSample sample = sample_points(scene, region);
  if (!scene.stations.empty()) {
    sample = main_parts(sample);
    const double outside = outside_of(kind_of_scan(scene));
    if (outside > 0.0) sample = within_box(sample, upright_axes(scene.up), outside);
  }
  if (sample.size() > 0) return sample;
  for (int corner = 0; corner < 8; ++corner) {
    sample.position.push_back(glm::mix(scene.bounds_min_world, scene.bounds_max_world,
                                       glm::bvec3((corner & 1) != 0, (corner & 2) != 0, (corner & 4) != 0)));
    sample.normal.push_back(glm::normalize(scene.up));
  }
  return sample;
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

/// A camera that holds these points.
Camera fitted_camera(const Scene& scene, const std::vector<glm::dvec3>& points, double aspect,
                     double fov_y_deg, const glm::dmat3& axes) {
  const glm::dvec3 center = 0.5 * (scene.bounds_min_world + scene.bounds_max_world);
  const double slope = std::tan(0.5 * fov_y_deg * DEG) / MARGIN;
  AxisFit horizontal{slope * aspect}, vertical{slope};
  for (const glm::dvec3& point : points) {
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

/// The picture's right, up and back, seen from there; the scene's up is the picture's but from straight above or below.
glm::dmat3 angled_axes(const glm::dmat3& axes, double azimuth_deg, double elevation_deg) {
  const double azimuth = azimuth_deg * DEG, elevation = elevation_deg * DEG;
  const glm::dvec3 level = std::cos(azimuth) * axes[2] + std::sin(azimuth) * axes[0];
  const glm::dvec3 back = std::cos(elevation) * level + std::sin(elevation) * axes[1];
  const bool steep = std::abs(elevation_deg) > STEEPEST_DEG;
  const glm::dvec3 right = glm::normalize(glm::cross(axes[1], steep ? level : back));
  return {right, glm::cross(back, right), back};
}

/// From which of four sides a doll's house is looked into: the usual one, unless walls face another more than twice as much, as in
/// half a room, of which the usual view may leave both walls out.
double doll_azimuth(const PointSample& sample, const glm::dmat3& upright) {
  constexpr double MORE = 2.0, WALL = 0.5;  // height of a wall's normal, at most
  const auto faced = [&](double azimuth_deg) {
    const glm::dvec3 back = angled_axes(upright, azimuth_deg, DOLL_ELEVATION_DEG)[2];
    return static_cast<double>(
        std::count_if(sample.normal.begin(), sample.normal.end(), [&](const glm::dvec3& normal) {
          return std::abs(glm::dot(normal, upright[1])) < WALL && glm::dot(normal, back) > 0.0;
        }));
  };
  double best = DOLL_AZIMUTH_DEG, most = MORE * faced(best);
  for (const double turn : {180.0, 90.0, -90.0})
    if (const double here = faced(DOLL_AZIMUTH_DEG + turn); here > most)
      best = DOLL_AZIMUTH_DEG + turn, most = here;
  return best;
}

/// Into a room from above, its frame about what faces the eye: the rest is left out.
Camera camera_into_dollhouse(const Scene& scene, double aspect, double fov_y_deg, const Region& region) {
  const glm::dmat3 upright = upright_axes(scene.up);
  const PointSample sample = framed_points(scene, region);
  const glm::dmat3 axes = angled_axes(upright, doll_azimuth(sample, upright), DOLL_ELEVATION_DEG);
  std::vector<glm::dvec3> facing;
  for (std::size_t i = 0; i < sample.normal.size(); ++i)
    if (glm::dot(sample.normal[i], axes[2]) > 0.0) facing.push_back(sample.position[i]);
  Camera camera = fitted_camera(scene, facing.empty() ? sample.position : facing, aspect, fov_y_deg, axes);
  camera.up = upright[1];
  return camera;
}

/// From the first sensor's place, as wide as holds what it saw, or filled with it where that fills a frame.
Camera camera_at_sensor(const Scene& scene, const glm::dvec3& sensor, double aspect,
                        std::optional<double> fov_y_deg) {
  const PointSample sample = framed_points(scene, {});
  glm::dvec3 ahead(0.0);
  double reach = 0.0;
  for (const glm::dvec3& point : sample.position) {
    if (point != sensor) ahead += glm::normalize(point - sensor);
    reach += glm::distance(point, sensor) / static_cast<double>(sample.size());
  }
  const glm::dmat3 axes = upright_axes(scene.up);
  ahead = glm::length(ahead) > 0.0 ? glm::normalize(ahead) : -axes[2];
  Camera camera;
  camera.eye = sensor;
  camera.target = sensor + std::max(reach, scene.root.unit_world) * ahead;
  camera.up = glm::length(glm::cross(axes[1], ahead)) > 1e-3 ? axes[1] : -axes[2];
  const glm::dvec3 right = glm::normalize(glm::cross(ahead, camera.up)), up = glm::cross(right, ahead);
  std::vector<double> slopes;
  for (const glm::dvec3& point : sample.position) {
    const glm::dvec3 q = point - sensor;
    const double depth = glm::dot(q, ahead);
    const double most = std::max(std::abs(glm::dot(q, right)) / aspect, std::abs(glm::dot(q, up)));
    slopes.push_back(depth > 0.0 ? most / depth : std::numeric_limits<double>::infinity());
  }
  const double slope = value_at(slopes, SENSOR_SHARE);
  camera.fov_y_deg = std::clamp(2.0 * std::atan(slope) / DEG, 1.0, SENSOR_MOST_DEG);
  fill_with_frame(sample, aspect, camera);
  camera.fov_y_deg = fov_y_deg.value_or(camera.fov_y_deg);
  return camera;
}

/// A depth camera's own view, filled with what it saw where that fills a frame, else cropped to the picture's shape where that is wider
/// than its grid.
Camera cropped_camera(const Scene& scene, double aspect, std::optional<double> fov_y_deg) {
  Camera camera = *scene.camera;
  if (!fill_with_frame(framed_points(scene, {}), aspect, camera)) {
    double grid = aspect;
    for (const Station& station : scene.stations)
      if (station.rows > 0 && station.columns > 0) grid = static_cast<double>(station.columns) / station.rows;
    const double crop = std::clamp(aspect / grid, 1.0, CROP_MOST);
    camera.fov_y_deg = 2.0 * std::atan(std::tan(0.5 * camera.fov_y_deg * DEG) / crop) / DEG;
  }
  camera.fov_y_deg = fov_y_deg.value_or(camera.fov_y_deg);
  return camera;
}

/// The camera of Viewpoint::sensor.
Camera sensor_camera(const Scene& scene, double aspect, std::optional<double> fov_y_deg) {
  if (scene.camera) return cropped_camera(scene, aspect, fov_y_deg);
  const PointSample sample = sample_points(scene);
  const std::optional<glm::dvec3> seeing = seeing_place(scene, sample),
                                  sensor = seeing ? seeing : first_sensor(scene);
  if (sensor) return camera_at_sensor(scene, *sensor, aspect, fov_y_deg);
  const double fov = fov_y_deg.value_or(DEFAULT_FOV_Y_DEG);
  return is_camera_frame(scene, sample) ? framing_camera(scene, aspect, fov, upright_axes(scene.up))
                                        : framing_camera(scene, aspect, fov);
}

/// Among places on the level of `middle`, those of a grid across `size` about it, the one that is furthest from all points that stand on
/// that level, with points all around and overhead where there is such a place.
glm::dvec3 roomy_place(const PointSample& sample, const glm::dmat3& axes, const glm::dvec3& middle,
                       const glm::dvec3& size) {
  constexpr int STEPS = 10;      // from end to end, of which those at the ends are walls
  constexpr double LEVEL = 0.2;  // of the height, up and down: neither floor nor ceiling
  std::vector<glm::dvec3> standing;
  for (const glm::dvec3& point : sample.position)
    if (std::abs(glm::dot(point - middle, axes[1])) < LEVEL * size.y) standing.push_back(point);
  const auto room_at = [&](const glm::dvec3& place) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const glm::dvec3& point : standing) {
      const glm::dvec3 away = glm::transpose(axes) * (point - place);
      nearest = std::min(nearest, std::hypot(away.x, away.z));
    }
    return std::pair(is_within(sample, place, axes), nearest);
  };
  glm::dvec3 best = middle;
  std::pair most = room_at(middle);
  for (int i = 1; i < STEPS; ++i)
    for (int j = 1; j < STEPS; ++j) {
      const glm::dvec3 place = middle + (double(i) / STEPS - 0.5) * size.x * axes[0] +
                               (double(j) / STEPS - 0.5) * size.z * axes[2];
      const std::pair here = room_at(place);
      if (!(here > most)) continue;
      best = place;
      most = here;
    }
  return best;
}

/// Which way a scan whose walls do not close it in is looked at from within: of 16 level directions, a little down, the one that shows
/// most, little of it next to the eye and in one plane.
glm::dvec3 direction_outside(const PointSample& sample, Camera camera, const glm::dmat3& axes) {
  constexpr int DIRECTIONS = 16;
  constexpr double DOWN = 0.08;  // of the way ahead
  glm::dvec3 best = -axes[2];
  double most = -1.0;
  for (int i = 0; i < DIRECTIONS; ++i) {
    const double turn = 2.0 * std::numbers::pi * i / DIRECTIONS;
    const glm::dvec3 ahead =
        glm::normalize(std::cos(turn) * axes[0] + std::sin(turn) * axes[2] - DOWN * axes[1]);
    camera.target = camera.eye + ahead;
    const ViewFigures figures = view_figures(sample, camera, false);
    const double shown = (1.0 - figures.background) * (1.0 - figures.near) * (1.0 - figures.plane);
    if (!(shown > most)) continue;
    most = shown;
    best = ahead;
  }
  return best;
}

Camera camera_inside(const Scene& scene, double fov_y_deg, const Region& region) {
  const PointSample sample = framed_points(scene, region);
  const glm::dmat3 axes = upright_axes(scene.up);
  const glm::dvec3 center = 0.5 * (scene.bounds_min_world + scene.bounds_max_world);
  glm::dvec3 size(0.0), middle(0.0);
  for (int axis = 0; axis < 3; ++axis) {
    const auto [low, high] = range_along(sample.position, axes[axis], OUTERMOST);
    size[axis] = high - low;
  }
  Camera camera;
  const std::optional<glm::dvec3> free = station_within(scene, sample),
                                  sensor = free ? free : first_sensor(scene);
  camera.eye =
      sensor ? *sensor : roomy_place(sample, axes, center - (0.5 - EYE_SHARE) * size.y * axes[1], size);
  for (const glm::dvec3& point : sample.position) middle += point / static_cast<double>(sample.size());
  glm::dvec3 ahead = middle - camera.eye;
  ahead -= glm::dot(ahead, axes[1]) * axes[1];
  if (glm::length(ahead) <= CENTRAL * scene.diagonal_world()) ahead = size.x > size.z ? axes[0] : -axes[2];
  const double distance = 0.5 * std::max({size.x, size.z, scene.root.unit_world});
  camera.up = axes[1];
  camera.fov_y_deg = fov_y_deg;
  ahead = sensor && !free ? direction_outside(sample, camera, axes) : glm::normalize(ahead);
  camera.target = camera.eye + distance * ahead;
  return camera;
}

/// Whether a file says of one of a room's scanners that it stood in it: rooms whose scanner's place was found are looked into from above.
bool stands_within(const Scene& scene) {
  return std::any_of(scene.stations.begin(), scene.stations.end(),
                     [](const Station& station) { return station.sensor_world.has_value(); }) &&
         station_within(scene, main_parts(sample_points(scene)));
}

}  // namespace

Viewpoint choose_viewpoint(const Scene& scene) {
  switch (kind_of_scan(scene)) {
    case SceneKind::camera:
      return Viewpoint::sensor;
    case SceneKind::room:
      return stands_within(scene) ? Viewpoint::inside : Viewpoint::dollhouse;
    case SceneKind::sweep:
      return first_sensor(scene) ? Viewpoint::inside : Viewpoint::oblique;
    case SceneKind::site:
      return Viewpoint::oblique;
    default:
      return is_model_of_room(scene) ? Viewpoint::inside : Viewpoint::front;
  }
}

const char* viewpoint_name(Viewpoint viewpoint) {
  static constexpr std::array NAMES = {"auto", "front", "oblique", "top", "inside", "dollhouse", "sensor"};
  return NAMES[static_cast<std::size_t>(viewpoint)];
}

Camera viewpoint_camera(const Scene& scene, Viewpoint viewpoint, double aspect,
                        std::optional<double> fov_y_deg, const Region& region) {
  const double fov = fov_y_deg.value_or(DEFAULT_FOV_Y_DEG);
  const glm::dmat3 axes = upright_axes(scene.up);
  switch (viewpoint == Viewpoint::automatic ? choose_viewpoint(scene) : viewpoint) {
    case Viewpoint::oblique:
      return angled_camera(scene, aspect, fov, DEFAULT_AZIMUTH_DEG, OBLIQUE_DEG, region);
    case Viewpoint::top:
      return framing_camera(scene, aspect, fov, {axes[0], -axes[2], axes[1]}, region);
    case Viewpoint::inside:
      return camera_inside(scene, fov_y_deg.value_or(INSIDE_FOV_Y_DEG), region);
    case Viewpoint::dollhouse:
      return camera_into_dollhouse(scene, aspect, fov_y_deg.value_or(DOLL_FOV_Y_DEG), region);
    case Viewpoint::sensor:
      return sensor_camera(scene, aspect, fov_y_deg);
    case Viewpoint::automatic:
    case Viewpoint::front:
      break;
  }
  const PointSample sample = framed_points(scene, region);
  const double azimuth_deg =
      kind_of_scan(scene) == SceneKind::object ? broad_azimuth_deg(sample, axes) : DEFAULT_AZIMUTH_DEG;
  Camera camera = fitted_camera(scene, sample.position, aspect, fov,
                                angled_axes(axes, azimuth_deg, DEFAULT_ELEVATION_DEG));
  camera.up = axes[1];
  return camera;
}

Camera default_camera(const Scene& scene, double aspect) {
  return scene.camera ? *scene.camera : framing_camera(scene, aspect);
}

Camera framing_camera(const Scene& scene, double aspect, double fov_y_deg) {
  return angled_camera(scene, aspect, fov_y_deg, DEFAULT_AZIMUTH_DEG, DEFAULT_ELEVATION_DEG);
}

Camera angled_camera(const Scene& scene, double aspect, double fov_y_deg, double azimuth_deg,
                     double elevation_deg, const Region& region) {
  const glm::dmat3 axes = upright_axes(scene.up);
  Camera camera =
      framing_camera(scene, aspect, fov_y_deg, angled_axes(axes, azimuth_deg, elevation_deg), region);
  if (std::abs(elevation_deg) <= STEEPEST_DEG) camera.up = axes[1];
  return camera;
}

Camera framing_camera(const Scene& scene, double aspect, double fov_y_deg, const glm::dmat3& axes,
                      const Region& region) {
  return fitted_camera(scene, framed_points(scene, region).position, aspect, fov_y_deg, axes);
}

}  // namespace splatray
