#include "preprocess/scan/grid/grid_surface.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "engine/base/release.h"
#include "preprocess/base/select.h"
#include "preprocess/scan/grid/depth_grid.h"
#include "preprocess/scan/grid/grid_planes.h"
#include "preprocess/scan/grid/pinhole.h"

namespace splatray {
namespace {

constexpr double NOISY_GRID = 0.05;    // noise_of a depth camera's grid from which its points are moved
constexpr double LAYERS = 0.85;        // noise_of a grid over that in space, below which there are layers
constexpr float LEAST_SUPPORT = 8.0F;  // weight of the cells that support a point: a quarter of a full window
constexpr float SPARSE_SUPPORT =
    1.0F / 3.0F;                       // of the median support, the same in grids with many empty cells
constexpr double DISC_REACH = 0.85;    // of a disc, in cells: half a diagonal and some more
constexpr double LEAST_COSINE = 0.25;  // of the slant that discs grow with

std::vector<std::uint32_t> points_of(const Cloud& cloud, std::size_t station) {
  return numbers_where(cloud.size(), [&](std::size_t i) { return cloud.station_of(i) == station; });
}

/// What a grid says of one of its points.
struct GridPoint {
  glm::dvec3 normal{0.0};  ///< towards the sensor; zero = the rays around do not determine it
  glm::dvec3 place_world{0.0};
  double radius_world = 0.0;  ///< that closes the grid
};

/// The plane g.p = 1 of a cell: its inverse depth is g.ray, and so are its slopes those of the rays.
GridPoint grid_point(const Cloud& cloud, const DepthGrid& grid, std::size_t cell) {
  const glm::dvec3 ray = grid.ray(cloud, cell);
  const double depth = 1.0 / double{grid.inverse[cell]};
  GridPoint result;
  result.place_world = grid.sensor_world + depth * ray;
  const glm::dvec3 right = grid.ray_slope(cloud, cell, 0), down = grid.ray_slope(cloud, cell, 1);
  const glm::dmat3 rays = glm::transpose(glm::dmat3(ray, right, down));
  const double wide = glm::length(right), high = glm::length(down);
  constexpr double SQUARE = 0.05;  // sine between rows and columns that make a grid
  if (!(std::abs(glm::determinant(rays)) > SQUARE * wide * high)) return result;
  const glm::dvec3 plane =
      glm::inverse(rays) * glm::dvec3(grid.inverse[cell], grid.slope[cell].x, grid.slope[cell].y);
  result.normal = -glm::normalize(plane);
  const double cosine = -glm::dot(result.normal, glm::normalize(ray));
  result.radius_world = DISC_REACH / std::max(cosine, LEAST_COSINE) * depth * std::max(wide, high);
  return result;
}

/// Empties cells that few others support, as usual for the grid; their points.
std::vector<std::uint32_t> take_unsupported(DepthGrid& grid, const std::vector<float>& supports) {
  std::vector<float> usual;
  for (const float support : supports)
    if (support > 0.0F) usual.push_back(support);
  if (usual.empty()) return {};
  const float least = std::min(LEAST_SUPPORT, SPARSE_SUPPORT * median_of(std::span(usual)));
  std::vector<std::uint32_t> points;
  for (std::size_t cell = 0; cell < grid.size(); ++cell) {
    if (grid.point[cell] == NO_CELL || supports[cell] >= least) continue;
    points.push_back(grid.point[cell]);
    grid.point[cell] = NO_CELL;
    grid.inverse[cell] = 0.0F;
  }
  return points;
}

/// The places of a cloud's points, to be changed.
std::vector<glm::dvec3> places_of(const Cloud& cloud) {
  std::vector<glm::dvec3> places(cloud.size());
  tbb::parallel_for(std::size_t{0}, places.size(), [&](std::size_t i) { places[i] = cloud.place_world(i); });
  return places;
}

/// The median of how far points that moved did.
double median_move(const Cloud& cloud, const std::vector<glm::dvec3>& places) {
  std::vector<double> moves;
  for (std::size_t i = 0; i < places.size(); ++i)
    if (const double move = glm::distance(cloud.place_world(i), places[i]); move > 0.0) moves.push_back(move);
  return moves.empty() ? 0.0 : median_of(std::span(moves));
}

std::vector<GridPoint> grid_points(const Cloud& cloud, const DepthGrid& grid) {
  std::vector<GridPoint> points(grid.size());
  tbb::parallel_for(std::size_t{0}, grid.size(), [&](std::size_t cell) {
    if (grid.point[cell] != NO_CELL) points[cell] = grid_point(cloud, grid, cell);
  });
  return points;
}

/// Gives a depth camera's points what their grid says; what it does not determine is in no grid from then on.
void settle(Cloud& cloud, const DepthGrid& grid, std::vector<glm::dvec3>& places, GridSurface& surface) {
  const std::vector<GridPoint> points = grid_points(cloud, grid);
  cloud.radius.resize(cloud.size(), 0.0F);
  std::fill(cloud.grid_cell.begin(), cloud.grid_cell.end(), NO_CELL);
  for (std::size_t cell = 0; cell < grid.size(); ++cell) {
    const std::uint32_t i = grid.point[cell];
    if (i == NO_CELL || points[cell].normal == glm::dvec3(0.0)) continue;
    cloud.grid_cell[i] = static_cast<std::uint32_t>(cell);
    places[i] = points[cell].place_world;
    ++surface.points;
    if (!(cloud.radius[i] > 0.0F))
      cloud.radius[i] = static_cast<float>(points[cell].radius_world / cloud.half_extent_world);
    if (cloud.normal[i] != glm::vec3(0.0F)) continue;
    cloud.normal[i] = glm::vec3(points[cell].normal);
    ++surface.normals;
  }
}

/// Whether a station's grid can be looked at: with a known place and enough points.
bool has_usable_grid(const Cloud& cloud, const Station& station, const std::vector<std::uint32_t>& points) {
  return !cloud.grid_cell.empty() && station.sensor_world && station.rows > 1 && station.columns > 1 &&
         points.size() >= FEWEST_TELLING;
}

}  // namespace

GridSurface find_grid_surface(Cloud& cloud, bool move, const Stage& stage) {
  GridSurface surface;
  if (cloud.stations.size() != 1) return surface;
  const std::vector<std::uint32_t> points = points_of(cloud, 0);
  if (!has_usable_grid(cloud, cloud.stations[0], points)) return surface;
  const auto pinhole = fit_pinhole(cloud, cloud.stations[0], points);
  if (!pinhole) return surface;
  DepthGrid grid = make_depth_grid(cloud, cloud.stations[0], points, pinhole->axes[2]);
  const DepthUnit unit = find_unit(grid);
  const double noise = noise_of(cloud, grid, unit);
  if (!(noise > NOISY_GRID)) return surface;
  surface.noise = noise;
  const std::vector<std::uint32_t> mixed = take_unsupported(grid, find_first_slopes(grid, unit, stage));
  fit_planes(grid, unit, stage);
  std::vector<glm::dvec3> places = places_of(cloud);
  settle(cloud, grid, places, surface);
  if (move) {
    surface.moved = surface.points;
    surface.moved_median_world = median_move(cloud, places);
    cloud.position = std::move(places);
  }
  std::vector<std::uint8_t> stays(cloud.size(), 1);
  for (const std::uint32_t i : mixed) stays[i] = 0;
  surface.mixed = mixed.size();
  keep_points(cloud, numbers_where(cloud.size(), [&](std::size_t i) { return stays[i] != 0; }));
  follow_positions(cloud);
  return surface;
}

Smoothed smooth_by_grids(Cloud& cloud, const std::vector<std::uint8_t>& estimated, double noise,
                         const Stage& stage) {
  std::vector<DepthGrid> grids;
  for (std::size_t s = 0; s < cloud.stations.size(); ++s) {
    const std::vector<std::uint32_t> points = points_of(cloud, s);
    if (std::none_of(points.begin(), points.end(), [&](auto i) { return estimated[i] != 0; })) continue;
    if (!has_usable_grid(cloud, cloud.stations[s], points)) return {};
    const auto pinhole = fit_pinhole(cloud, cloud.stations[s], points);
    grids.push_back(
        make_depth_grid(cloud, cloud.stations[s], points, pinhole ? pinhole->axes[2] : glm::dvec3(0.0)));
    const double calm = noise_of(cloud, grids.back(), find_unit(grids.back()));
    if (!(calm > 0.0) || (cloud.stations.size() > 1 && calm < LAYERS * noise)) return {};
  }
  std::vector<glm::dvec3> places = places_of(cloud);
  Smoothed smoothed;
  for (DepthGrid& grid : grids) {
    const DepthUnit unit = find_unit(grid);
    take_unsupported(grid, find_first_slopes(grid, unit, stage));
    fit_planes(grid, unit, stage);
    const std::vector<GridPoint> points = grid_points(cloud, grid);
    for (std::size_t cell = 0; cell < grid.size(); ++cell) {
      const std::uint32_t i = grid.point[cell];
      if (i == NO_CELL || estimated[i] == 0 || points[cell].normal == glm::dvec3(0.0)) continue;
      cloud.normal[i] = glm::vec3(points[cell].normal);
      places[i] = points[cell].place_world;
      ++smoothed.moved;
    }
  }
  if (smoothed.moved == 0) return smoothed;
  smoothed.moved_median_world = median_move(cloud, places);
  const bool by_coordinates = cloud.position.empty();
  cloud.position = std::move(places);
  follow_positions(cloud);
  if (by_coordinates) release(cloud.position);
  return smoothed;
}

}  // namespace splatray
