#include "preprocess/scan/range_grid.h"

#include <cmath>
#include <limits>

namespace splatray {
namespace {

/// Unit directions of the grid's rows and columns.
constexpr std::array<std::array<int, 2>, 8> COMPASS{
    {{-1, -1}, {-1, 0}, {-1, 1}, {0, 1}, {1, 1}, {1, 0}, {1, -1}, {0, -1}}};

}  // namespace

RangeGrid::RangeGrid(const Cloud& cloud, const Station& station, const std::vector<std::uint32_t>& points)
    : cloud_(cloud) {
  const std::uint64_t cells = std::uint64_t{station.rows} * station.columns;
  const bool is_line = std::min(station.rows, station.columns) < 2;  // a list that is called a grid
  if (!station.sensor_world || cloud.grid_cell.empty() || is_line ||
      cells > MOST_CELLS_PER_POINT * points.size())
    return;
  rows_ = station.rows;
  columns_ = station.columns;
  sensor_ = cloud.in_cloud(*station.sensor_world);
  point_.resize(cells, NO_CELL);
  for (const std::uint32_t i : points)
    if (cloud.grid_cell[i] < cells) point_[cloud.grid_cell[i]] = i;
}

double RangeGrid::range(std::uint32_t point) const {
  return glm::length(glm::dvec3(cloud_.coord[point]) - sensor_);
}

std::uint32_t RangeGrid::beside(std::uint32_t point, int rows, int columns) const {
  const std::uint32_t cell = cloud_.grid_cell[point];
  if (cell >= point_.size()) return NO_CELL;
  const std::int64_t row = cell / columns_ + rows;
  const std::int64_t column = (cell % columns_ + columns + columns_) % columns_;
  if (row < 0 || row >= rows_) return NO_CELL;
  return point_[static_cast<std::size_t>(row * columns_ + column)];
}

std::array<float, 8> RangeGrid::off_lines(std::uint32_t point) const {
  std::array<float, 8> off;
  const double here = range(point);
  for (std::size_t d = 0; d < off.size(); ++d) {
    off[d] = std::numeric_limits<float>::infinity();
    const std::uint32_t next = beside(point, COMPASS[d][0], COMPASS[d][1]);
    const std::uint32_t after = beside(point, 2 * COMPASS[d][0], 2 * COMPASS[d][1]);
    if (next == NO_CELL || after == NO_CELL) continue;
    const double expected = 2.0 / range(next) - 1.0 / range(after);
    off[d] = static_cast<float>(
        std::abs(here - here * here * expected));  // 1 / expected to first order, which does not run off
  }
  return off;
}

}  // namespace splatray
