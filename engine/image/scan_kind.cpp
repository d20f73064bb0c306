#include "engine/image/scan_kind.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "engine/image/view.h"
#include "engine/scene/scene_splat.h"

namespace splatray {
namespace {

constexpr double RADIAN = std::numbers::pi / 180.0;  ///< in a degree
constexpr std::size_t SIGHT_CELLS = 64;              ///< across the field, each way
constexpr double LOOKING_DOWN = -0.3;                ///< mean of the normals' z
constexpr double NEAR_ORIGIN = 5.0;                  ///< times the size
constexpr double LAYER = 0.15, LAYER_SHARE = 0.1;
constexpr std::size_t SECTORS = 12;
constexpr std::size_t OVERHEAD_BANDS = 2;
constexpr std::ptrdiff_t OVERHEAD_SEEN = 18;  ///< of 24 parts of the sky
constexpr std::size_t FEW_POINTS = 3;         ///< fewer in a part of the directions are strays
constexpr double LEVEL_DEG = 30.0, OVERHEAD_DEG = 45.0, STEEP_DEG = 60.0;
constexpr double FACING_SHARE = 0.6;   ///< of a room's normals, which face in
constexpr double SIZE_OUTSIDE = 0.01;  ///< share of the points at each end that the middle does not see
constexpr double SWEEP_NEAR = 0.6, SWEEP_REACH = 0.9;
/// Seven sweeps have half of their points in 0.14 to 0.38 of their cells, a dozen things that were sampled evenly in 0.52 to 0.63.
constexpr double SWEEP_CELLS = 16.0, SWEEP_CELLS_NEAR = 0.45;
/// A place is free if fewer than this fraction of the points lie within this fraction of the diagonal.
constexpr double FREE_SHARE = 0.02, FREE_POINTS = 0.002;

glm::dvec3 robust_middle(const PointSample& sample, const glm::dmat3& axes) {
  glm::dvec3 middle(0.0);
  for (int axis = 0; axis < 3; ++axis) {
    const auto [low, high] = range_along(sample.position, axes[axis], SIZE_OUTSIDE);
    middle += 0.5 * (low + high) * axes[axis];
  }
  return middle;
}

std::size_t sector_of(const glm::dvec3& upright) {
  const double turn = (std::atan2(upright.z, upright.x) / std::numbers::pi + 1.0) / 2.0;
  return std::min(static_cast<std::size_t>(turn * SECTORS), SECTORS - 1);
}

/// Whether most normals turn to a place, of what is overhead there as well: ground above a place is no ceiling.
bool face(const PointSample& sample, const glm::dvec3& place, const glm::dmat3& axes) {
  std::size_t facing = 0, overhead = 0, overhead_facing = 0;
  for (std::size_t i = 0; i < sample.size(); ++i) {
    const glm::dvec3 q = glm::transpose(axes) * (sample.position[i] - place);
    const bool above = q.y > std::hypot(q.x, q.z),
               turned = glm::dot(sample.normal[i], place - sample.position[i]) > 0.0;
    facing += turned ? 1 : 0;
    overhead += above ? 1 : 0;
    overhead_facing += above && turned ? 1 : 0;
  }
  return share_of(facing, sample.size()) > FACING_SHARE && share_of(overhead_facing, overhead) > FACING_SHARE;
}

bool is_room(const Scene& scene, const PointSample& sample, const glm::dmat3& axes) {
  const glm::dvec3 place = station_within(scene, sample).value_or(robust_middle(sample, axes));
  return is_within(sample, place, axes) && face(sample, place, axes);
}

/// In which sectors of azimuth around a place enough points lie.
std::size_t sectors_around(const PointSample& sample, const glm::dvec3& place, const glm::dmat3& axes,
                           double most_deg) {
  std::array<std::size_t, SECTORS> around{};
  for (const glm::dvec3& point : sample.position) {
    const glm::dvec3 q = glm::transpose(axes) * (point - place);
    if (std::abs(q.y) < std::tan(most_deg * RADIAN) * std::hypot(q.x, q.z)) ++around[sector_of(q)];
  }
  return static_cast<std::size_t>(
      std::count_if(around.begin(), around.end(), [](std::size_t points) { return points >= FEW_POINTS; }));
}

/// How many of the cells with points within `reach` of a place have some within `half`, as a share; cubes of 1/SWEEP_CELLS of `reach`.
double share_of_cells_near(const PointSample& sample, const glm::dvec3& place, double half, double reach) {
  std::set<std::array<int, 3>> all, near;
  for (const glm::dvec3& point : sample.position) {
    const double away = glm::distance(point, place);
    if (away > reach) continue;
    const glm::ivec3 cell(glm::floor((point - place) * (SWEEP_CELLS / reach)));
    all.insert({cell.x, cell.y, cell.z});
    if (away <= half) near.insert({cell.x, cell.y, cell.z});
  }
  return share_of(near.size(), all.size());
}

/// Whether the points crowd around a place.
bool is_crowded(const PointSample& sample, const glm::dvec3& place) {
  std::vector<double> away;
  for (const glm::dvec3& point : sample.position) away.push_back(glm::distance(point, place));
  std::sort(away.begin(), away.end());
  const auto at = [&](double share) {
    return away[static_cast<std::size_t>(share * static_cast<double>(away.size() - 1))];
  };
  const double half = at(0.5), reach = at(SWEEP_REACH);
  return half < SWEEP_NEAR * reach && share_of_cells_near(sample, place, half, reach) < SWEEP_CELLS_NEAR;
}

/// Whether there is one layer of points along z, near the origin, whose normals look to -z.
bool is_layer_that_looks_down(const PointSample& sample) {
  if (!(mean_normal(sample).z < LOOKING_DOWN)) return false;
  const glm::dmat3 axes(1.0);
  const glm::dvec3 size = robust_size(sample, axes), middle = robust_middle(sample, axes);
  const double across = std::max(size.x, size.y);
  if (!(across > 0.0) || glm::length(middle) > NEAR_ORIGIN * glm::length(size)) return false;
  const auto cell_of = [&](const glm::dvec3& point) {
    const auto along = [&](double from_middle) {
      return static_cast<std::size_t>(
          std::clamp((from_middle / across + 0.5) * SIGHT_CELLS, 0.0, SIGHT_CELLS - 1.0));
    };
    return along(point.x - middle.x) * SIGHT_CELLS + along(point.y - middle.y);
  };
  std::array<double, SIGHT_CELLS * SIGHT_CELLS> nearest;
  nearest.fill(std::numeric_limits<double>::infinity());
  for (const glm::dvec3& point : sample.position) {
    double& first = nearest[cell_of(point)];
    first = std::min(first, point.z);
  }
  const auto behind = std::count_if(
      sample.position.begin(), sample.position.end(),
      [&](const glm::dvec3& point) { return point.z > nearest[cell_of(point)] + LAYER * across; });
  return share_of(static_cast<std::size_t>(behind), sample.size()) < LAYER_SHARE;
}

}  // namespace

bool is_built(const PointSample& sample, const glm::dmat3& axes) {
  constexpr double WALL_DEG = 10.0, WALL_SHARE = 0.5;
  const auto walls = std::count_if(sample.normal.begin(), sample.normal.end(), [&](const glm::dvec3& normal) {
    const double up = std::abs(glm::dot(normal, axes[1]));
    return up > std::cos(WALL_DEG * RADIAN) || up < std::sin(WALL_DEG * RADIAN);
  });
  return share_of(static_cast<std::size_t>(walls), sample.size()) > WALL_SHARE;
}

bool is_model_of_room(const Scene& scene) {
  if (!scene.stations.empty() || scene.camera || splat_count(scene) == 0) return false;
  const PointSample sample = sample_points(scene);
  const glm::dmat3 axes = upright_axes(scene.up);
  return is_built(sample, axes) && is_room(scene, sample, axes);
}

const char* scan_kind_name(SceneKind kind) {
  static constexpr std::array NAMES = {"a model", "an object", "a site",
                                       "a sweep", "a room",    "what one sensor saw"};
  return NAMES[static_cast<std::size_t>(kind)];
}

std::optional<glm::dvec3> first_sensor(const Scene& scene) {
  for (const Station& station : scene.stations)
    if (const auto place = sensor_place_world(station)) return place;
  return {};
}

bool is_camera_frame(const Scene& scene, const PointSample& sample) {
  if (scene.stations.size() != 1 || scene.stations.front().sensor_world || sample.size() == 0) return false;
  return is_seen_along_z(sample, scene.up) || is_layer_that_looks_down(sample);
}

std::optional<glm::dvec3> seeing_place(const Scene& scene, const PointSample& sample) {
  if (scene.stations.size() != 1) return {};
  const std::optional<glm::dvec3> sensor = scene.stations.front().sensor_world;
  if (sensor) return is_in_field_of(sample, *sensor) ? sensor : std::nullopt;
  return is_seen_along_z(sample, scene.up) ? std::optional(glm::dvec3(0.0)) : std::nullopt;
}

bool is_within(const PointSample& sample, const glm::dvec3& place, const glm::dmat3& axes) {
  std::array<std::size_t, SECTORS * OVERHEAD_BANDS> overhead{};
  for (const glm::dvec3& point : sample.position) {
    const glm::dvec3 q = glm::transpose(axes) * (point - place);
    if (q.y <= std::hypot(q.x, q.z)) continue;
    // Bands of one height on the unit sphere are of one area.
    const double lowest = std::cos(OVERHEAD_DEG * RADIAN),
                 up = (q.y / glm::length(q) - lowest) / (1.0 - lowest);
    const auto band =
        std::min(static_cast<std::size_t>(std::max(up, 0.0) * OVERHEAD_BANDS), OVERHEAD_BANDS - 1);
    ++overhead[SECTORS * band + sector_of(q)];
  }
  const auto seen = [](std::size_t points) { return points >= FEW_POINTS; };
  return sectors_around(sample, place, axes, LEVEL_DEG) == SECTORS &&
         std::count_if(overhead.begin(), overhead.end(), seen) >= OVERHEAD_SEEN;
}

bool is_sweep(const PointSample& sample, const glm::dvec3& place, const glm::dmat3& axes) {
  return sectors_around(sample, place, axes, STEEP_DEG) == SECTORS && is_crowded(sample, place);
}

std::optional<glm::dvec3> station_within(const Scene& scene, const PointSample& sample) {
  const glm::dmat3 axes = upright_axes(scene.up);
  const double reach = FREE_SHARE * scene.diagonal_world();
  for (const Station& station : scene.stations) {
    const std::optional<glm::dvec3> sensor = sensor_place_world(station);
    if (!sensor) continue;
    const glm::dvec3 place = *sensor;
    const auto near = std::count_if(sample.position.begin(), sample.position.end(),
                                    [&](const glm::dvec3& p) { return glm::distance(p, place) < reach; });
    if (share_of(static_cast<std::size_t>(near), sample.size()) < FREE_POINTS &&
        is_within(sample, place, axes))
      return place;
  }
  return {};
}

SceneKind kind_of_scan(const Scene& scene) {
  if (scene.stations.empty() || splat_count(scene) == 0) return SceneKind::none;
  const PointSample all = sample_points(scene);
  if (scene.camera || seeing_place(scene, all) || is_camera_frame(scene, all)) return SceneKind::camera;
  const PointSample sample = main_parts(all);
  const glm::dmat3 axes = upright_axes(scene.up);
  if (is_room(scene, sample, axes)) return SceneKind::room;
  if (is_sweep(all, first_sensor(scene).value_or(glm::dvec3(0.0)), axes)) return SceneKind::sweep;
  return is_flat(sample, axes) ? SceneKind::site : SceneKind::object;
}

}  // namespace splatray
