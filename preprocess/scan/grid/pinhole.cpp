#include "preprocess/scan/grid/pinhole.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <utility>

#include "preprocess/base/parallel.h"
#include "preprocess/base/select.h"

namespace splatray {
namespace {

constexpr std::size_t MOST_SIGHTS = 8192;  // points that determine a camera well enough
constexpr std::size_t FEWEST_SIGHTS = 100;
constexpr double MOST_OFF = 0.5;        // of half of the points, in cells
constexpr double MOST_BEHIND = 0.01;    // share of points
constexpr double SQUARE_COSINE = 0.05;  // cosine between the axes of rows and columns, at most
constexpr double MOST_STRETCHED = 2.0;  // of cells

constexpr std::size_t UNKNOWNS = 8;
using EquationRow = std::array<double, UNKNOWNS + 1>;  ///< of linear equations, the right side last

/// Solves the system by elimination with pivots; false where it is singular.
bool solve(std::array<EquationRow, UNKNOWNS>& rows) {
  for (std::size_t k = 0; k < UNKNOWNS; ++k) {
    const auto begin = rows.begin() + static_cast<std::ptrdiff_t>(k);
    const auto pivot = std::max_element(begin, rows.end(), [k](const EquationRow& a, const EquationRow& b) {
      return std::abs(a[k]) < std::abs(b[k]);
    });
    if (!(std::abs((*pivot)[k]) > 0.0)) return false;
    std::swap(*begin, *pivot);
    for (std::size_t i = 0; i < UNKNOWNS; ++i) {
      if (i == k) continue;
      const double factor = rows[i][k] / rows[k][k];
      for (std::size_t j = k; j <= UNKNOWNS; ++j) rows[i][j] -= factor * rows[k][j];
    }
  }
  for (std::size_t k = 0; k < UNKNOWNS; ++k) rows[k][UNKNOWNS] /= rows[k][k];
  return true;
}

/// A point as it was seen: its direction, unit, and where in the grid, in halves of its longer side from its middle.
struct Sight {
  glm::dvec3 dir;
  glm::dvec2 cell;
};

std::vector<Sight> sights_of(const Cloud& cloud, const Station& station,
                             const std::vector<std::uint32_t>& points) {
  const double half = 0.5 * std::max(station.rows, station.columns);
  std::vector<Sight> sights;
  const std::size_t stride = points.size() / MOST_SIGHTS + 1;
  for (std::size_t n = 0; n < points.size(); n += stride) {
    const std::uint32_t cell = cloud.grid_cell[points[n]];
    const glm::dvec3 away = cloud.place_world(points[n]) - *station.sensor_world;
    if (cell / station.columns >= station.rows || !(glm::length(away) > 0.0)) continue;
    const glm::dvec2 place(cell % station.columns, cell / station.columns);
    const glm::dvec2 middle(0.5 * station.columns, 0.5 * station.rows);
    sights.push_back({glm::normalize(away), (place - middle) / half});
  }
  return sights;
}

/// The rows a, b and c of the matrix that takes directions to places in the grid: (a.dir, b.dir) / c.dir.
struct PinholeMatrix {
  glm::dvec3 a, b, c;
};

/// c = ahead + s u + t v, as its length is free and what all points are in front of is no cross direction.
std::optional<PinholeMatrix> project(const std::vector<Sight>& sights) {
  glm::dvec3 ahead(0.0);
  for (const Sight& sight : sights) ahead += sight.dir;
  if (!(glm::length(ahead) > 0.0)) return {};
  ahead = glm::normalize(ahead);
  const glm::dvec3 side = std::abs(ahead.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 u = glm::normalize(glm::cross(ahead, side)), v = glm::cross(ahead, u);
  std::array<EquationRow, UNKNOWNS> rows{};
  for (const Sight& sight : sights) {
    const glm::dvec3 d(glm::dot(sight.dir, u), glm::dot(sight.dir, v), glm::dot(sight.dir, ahead));
    const auto& [x, y] = std::pair(sight.cell.x, sight.cell.y);
    const EquationRow equations[2] = {{d.x, d.y, d.z, 0.0, 0.0, 0.0, -x * d.x, -x * d.y, x * d.z},
                                      {0.0, 0.0, 0.0, d.x, d.y, d.z, -y * d.x, -y * d.y, y * d.z}};
    for (const EquationRow& equation : equations)
      for (std::size_t i = 0; i < UNKNOWNS; ++i)
        for (std::size_t j = 0; j <= UNKNOWNS; ++j) rows[i][j] += equation[i] * equation[j];
  }
  if (!solve(rows)) return {};
  const auto found = [&](std::size_t k) { return rows[k][UNKNOWNS]; };
  return PinholeMatrix{found(0) * u + found(1) * v + found(2) * ahead,
                       found(3) * u + found(4) * v + found(5) * ahead, found(6) * u + found(7) * v + ahead};
}

/// Whether the points are where the projection has them; `half` a cell's size.
bool explains(const PinholeMatrix& projection, const std::vector<Sight>& sights, double half) {
  std::vector<double> off;
  for (const Sight& sight : sights) {
    const double depth = glm::dot(projection.c, sight.dir);
    if (!(depth > 0.0)) continue;
    const glm::dvec2 seen(glm::dot(projection.a, sight.dir), glm::dot(projection.b, sight.dir));
    off.push_back(half * glm::length(seen / depth - sight.cell));
  }
  const auto all = static_cast<double>(sights.size());
  if (static_cast<double>(off.size()) < (1.0 - MOST_BEHIND) * all) return false;
  return median_of(std::span(off)) < MOST_OFF;
}

/// The camera of a projection, if it is one.
std::optional<Pinhole> camera_of(const PinholeMatrix& projection, const Station& station) {
  const double length = glm::length(projection.c);
  const glm::dvec3 ahead = projection.c / length;
  const glm::dvec2 middle(glm::dot(projection.a, ahead) / length, glm::dot(projection.b, ahead) / length);
  const glm::dvec3 across = projection.a / length - middle.x * ahead;
  const glm::dvec3 down = projection.b / length - middle.y * ahead;
  const double half = 0.5 * std::max(station.rows, station.columns);
  Pinhole pinhole;
  pinhole.eye_world = *station.sensor_world;
  pinhole.focal = half * glm::dvec2(glm::length(across), glm::length(down));
  pinhole.middle = half * middle + glm::dvec2(0.5 * station.columns, 0.5 * station.rows);
  pinhole.axes = {glm::normalize(across), glm::normalize(down), ahead};
  const double stretched = pinhole.focal.x / pinhole.focal.y;
  if (!(std::abs(glm::dot(pinhole.axes[0], pinhole.axes[1])) < SQUARE_COSINE)) return {};
  if (!(stretched < MOST_STRETCHED && 1.0 / stretched < MOST_STRETCHED)) return {};
  return pinhole;
}

}  // namespace

std::optional<Pinhole> fit_pinhole(const Cloud& cloud, const Station& station,
                                   const std::vector<std::uint32_t>& points) {
  if (!station.sensor_world || cloud.grid_cell.empty() || std::min(station.rows, station.columns) < 2)
    return {};
  const std::vector<Sight> sights = sights_of(cloud, station, points);
  if (sights.size() < FEWEST_SIGHTS) return {};
  const auto projection = project(sights);
  const double half = 0.5 * std::max(station.rows, station.columns);
  if (!projection || !explains(*projection, sights, half)) return {};
  return camera_of(*projection, station);
}

std::optional<Camera> camera_of_scan(std::span<const Cloud> clouds) {
  if (clouds.size() != 1 || clouds[0].stations.size() != 1 || !clouds[0].measured) return {};
  const Cloud& cloud = clouds[0];
  const Station& station = cloud.stations[0];
  if (cloud.grid_cell.empty()) return {};
  std::vector<std::uint32_t> points(cloud.size());
  std::iota(points.begin(), points.end(), 0U);
  const auto pinhole = fit_pinhole(cloud, station, points);
  if (!pinhole) return {};
  const auto ray = [&](double column, double row) {
    const glm::dvec2 across = (glm::dvec2(column, row) - pinhole->middle) / pinhole->focal;
    return glm::normalize(pinhole->axes * glm::dvec3(across, 1.0));
  };
  const double column = 0.5 * station.columns - 0.5;  // of the grid's middle
  const glm::dvec3 top = ray(column, -0.5), bottom = ray(column, station.rows - 0.5);
  const glm::dvec3 dir = ray(column, 0.5 * station.rows - 0.5);
  std::vector<double> depths;
  for (const std::uint32_t i : points)
    depths.push_back(glm::dot(cloud.place_world(i) - pinhole->eye_world, dir));
  // Rows run down where columns run to the right; what is mirrored has them run up.
  const glm::dmat3& axes = pinhole->axes;
  const bool mirrored = glm::determinant(axes) < 0.0;
  Camera camera;
  camera.eye = pinhole->eye_world;
  camera.target = camera.eye + median_of(std::span(depths)) * dir;
  camera.up = mirrored ? axes[1] : -axes[1];
  camera.fov_y_deg = std::acos(std::clamp(glm::dot(top, bottom), -1.0, 1.0)) * 180.0 / std::numbers::pi;
  return camera;
}

}  // namespace splatray
