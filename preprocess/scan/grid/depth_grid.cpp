#include "preprocess/scan/grid/depth_grid.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <span>

#include "preprocess/base/select.h"
#include "preprocess/scan/range_grid.h"

namespace splatray {
namespace {

constexpr double SAME_VALUE = 1e-6;                 // relative difference of values that rounding made two of
constexpr double UNIT = 2.0 * std::numbers::sqrt3;  // a step over the standard deviation of what it rounds
constexpr double KEPT = 0.75;                       // share of second differences, the least, that show noise
constexpr double MEAN_OF_KEPT = 0.515;  // of their sizes, in standard deviations of the normal distribution
constexpr std::int64_t NEAR_CELLS = 4;  // cells within which rays show how they change

/// The median step between distinct values, which ascend.
double step_of(std::span<const float> values) {
  std::vector<double> steps;
  double last = values.front();
  for (const float value : values) {
    if (value - last > SAME_VALUE * value) steps.push_back(value - last), last = value;
  }
  return median_or_zero(steps);
}

/// The standard deviation of inverse depths between two of them about straight lines along the rows.
double deviation(const DepthGrid& grid, double least, double most) {
  std::vector<double> bends;
  for (std::size_t cell = 0; cell < grid.size(); ++cell) {
    const double here = grid.inverse[cell];
    const double left = grid.inverse_beside(cell, -1, 0), right = grid.inverse_beside(cell, 1, 0);
    if (here >= least && here <= most && left > 0.0 && right > 0.0)
      bends.push_back(std::abs(left - 2.0 * here + right));
  }
  const auto kept = static_cast<std::size_t>(KEPT * static_cast<double>(bends.size()));
  if (kept == 0) return 0.0;
  select_nth(std::span(bends), kept, std::identity());
  double sum = 0.0;
  for (std::size_t i = 0; i < kept; ++i) sum += bends[i];
  return sum / static_cast<double>(kept) / MEAN_OF_KEPT / std::sqrt(6.0);
}

/// The unit of the values, which ascend.
double unit_of(const DepthGrid& grid, std::span<const float> values) {
  const double step = step_of(values), all = deviation(grid, values.front(), values.back());
  const double rounding = step / UNIT;
  return std::max(step, UNIT * std::sqrt(std::max(all * all - rounding * rounding, 0.0)));
}

/// Whether the last column is beside the first: most rows that have both have them as close as two cells.
bool is_around(const Cloud& cloud, const DepthGrid& grid) {
  std::int64_t asked = 0, close = 0;
  for (std::int64_t row = 0; row < grid.rows; ++row) {
    const auto first = static_cast<std::size_t>(row * grid.columns),
               last = first + static_cast<std::size_t>(grid.columns) - 1;
    const glm::dvec3 step = grid.point[first] == NO_CELL ? glm::dvec3(0.0) : grid.ray_slope(cloud, first, 0);
    if (grid.point[last] == NO_CELL || step == glm::dvec3(0.0)) continue;
    ++asked;
    close += glm::distance(grid.ray(cloud, first), grid.ray(cloud, last)) < 2.0 * glm::length(step) ? 1 : 0;
  }
  return 2 * close > asked;
}

}  // namespace

double DepthUnit::of(double inverse) const { return unit * std::pow(inverse / at, power); }

std::size_t DepthGrid::beside(std::size_t cell, std::int64_t right, std::int64_t down) const {
  std::int64_t column = static_cast<std::int64_t>(cell) % columns + right;
  const std::int64_t row = static_cast<std::int64_t>(cell) / columns + down;
  if (around) column = (column + columns) % columns;
  const bool inside = column >= 0 && column < columns && row >= 0 && row < rows;
  return inside ? static_cast<std::size_t>(row * columns + column) : size();
}

double DepthGrid::depth(const glm::dvec3& place_world) const {
  const glm::dvec3 away = place_world - sensor_world;
  return axis == glm::dvec3(0.0) ? glm::length(away) : glm::dot(away, axis);
}

glm::dvec3 DepthGrid::ray(const Cloud& cloud, std::size_t cell) const {
  const glm::dvec3 place = cloud.place_world(point[cell]);
  return (place - sensor_world) / depth(place);
}

glm::dvec3 DepthGrid::ray_slope(const Cloud& cloud, std::size_t cell, int direction) const {
  const auto nearest = [&](std::int64_t side) -> std::pair<std::size_t, std::int64_t> {
    for (std::int64_t span = 1; span <= NEAR_CELLS; ++span) {
      const std::int64_t steps = side * span;
      const std::size_t other = direction == 0 ? beside(cell, steps, 0) : beside(cell, 0, steps);
      if (other < size() && point[other] != NO_CELL) return {other, steps};
    }
    return {cell, 0};
  };
  const auto [before, back] = nearest(-1);
  const auto [after, ahead] = nearest(1);
  if (ahead == back) return glm::dvec3(0.0);
  return (ray(cloud, after) - ray(cloud, before)) / static_cast<double>(ahead - back);
}

DepthGrid make_depth_grid(const Cloud& cloud, const Station& station,
                          const std::vector<std::uint32_t>& points, const glm::dvec3& axis) {
  DepthGrid grid;
  const std::uint64_t cells = std::uint64_t{station.rows} * station.columns;
  if (cells > MOST_CELLS_PER_POINT * points.size()) return grid;
  grid.sensor_world = *station.sensor_world;
  grid.axis = axis;
  grid.rows = station.rows, grid.columns = station.columns;
  grid.point.resize(cells, NO_CELL);
  grid.inverse.resize(cells);
  for (const std::uint32_t i : points) {
    const double depth = grid.depth(cloud.place_world(i));
    if (cloud.grid_cell[i] >= cells || !(depth > 0.0)) continue;
    grid.point[cloud.grid_cell[i]] = i;
    grid.inverse[cloud.grid_cell[i]] = static_cast<float>(1.0 / depth);
  }
  grid.around = is_around(cloud, grid);
  return grid;
}

DepthUnit find_unit(const DepthGrid& grid) {
  constexpr double APART = 1.1;  // ratio of inverse depths that shows how the unit depends on them
  std::vector<float> values;
  for (const float inverse : grid.inverse)
    if (inverse > 0.0F) values.push_back(inverse);
  if (values.size() < FEWEST_TELLING) return {};
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  const std::span<const float> far = std::span(values).first(half), near = std::span(values).subspan(half);
  const double far_unit = unit_of(grid, far), near_unit = unit_of(grid, near);
  const double apart = near[near.size() / 2] / far[half / 2];
  if (!(far_unit > 0.0)) return {near_unit, near[near.size() / 2], 0.0};  // all of it is one step
  DepthUnit unit{far_unit, far[half / 2], 0.0};
  if (apart > APART && near_unit > 0.0)
    unit.power = std::clamp(std::log(near_unit / far_unit) / std::log(apart), 0.0, 2.0);
  return unit;
}

double noise_of(const Cloud& cloud, const DepthGrid& grid, const DepthUnit& unit) {
  std::vector<double> noise;
  for (std::size_t cell = 0; cell < grid.size(); ++cell) {
    if (grid.point[cell] == NO_CELL) continue;
    const double inverse = grid.inverse[cell];
    const glm::dvec3 right = grid.ray_slope(cloud, cell, 0), down = grid.ray_slope(cloud, cell, 1);
    const double apart = std::numbers::sqrt2 * std::max(glm::length(right), glm::length(down)) * inverse;
    if (apart > 0.0) noise.push_back(unit.of(inverse) / UNIT / apart);
  }
  return median_or_zero(noise);
}

}  // namespace splatray
