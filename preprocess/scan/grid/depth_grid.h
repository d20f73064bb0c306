/// The inverse depths of a station by the cells of its grid.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "preprocess/surface/cloud.h"

namespace splatray {

/// The resolution of inverse depths, as a power of them: 0 for steps of disparity, 2 for what is even in depth.
struct DepthUnit {
  double unit = 0.0;  ///< 1 / world units, at the inverse depth `at`
  double at = 1.0, power = 0.0;

  [[nodiscard]] double of(double inverse) const;
};

/// Inverse depths, and how they change from cell to cell. On a plane they are linear in what is seen: where depths are along
/// an axis and the grid is a pinhole's, in columns and rows; where they are ranges, in small angles.
struct DepthGrid {
  glm::dvec3 sensor_world{0.0};
  glm::dvec3 axis{0.0};  ///< that depths are along, unit; zero = ranges
  std::int64_t rows = 0, columns = 0;
  bool around = false;               ///< the last column's next is the first
  std::vector<std::uint32_t> point;  ///< by cell, NO_CELL where nothing returned
  std::vector<float> inverse;        ///< 1 / world units, 0 where nothing returned
  std::vector<glm::vec2> slope;      ///< of these, a column and a row; empty until it is found

  [[nodiscard]] std::size_t size() const { return point.size(); }
  /// The number of the cell `right` and `down` beside another; size() where there is none.
  [[nodiscard]] std::size_t beside(std::size_t cell, std::int64_t right, std::int64_t down) const;
  /// Its inverse depth, 0 where there is none.
  [[nodiscard]] double inverse_beside(std::size_t cell, std::int64_t right, std::int64_t down) const {
    const std::size_t other = beside(cell, right, down);
    return other < size() ? double{inverse[other]} : 0.0;
  }
  /// The depth of a place, world units.
  [[nodiscard]] double depth(const glm::dvec3& place_world) const;
  /// Where a cell's line of sight is at depth 1, from the sensor. The cell is filled.
  [[nodiscard]] glm::dvec3 ray(const Cloud& cloud, std::size_t cell) const;
  /// How that changes a column (0) or a row (1), by the nearest filled cells within a few; zero where there are none.
  [[nodiscard]] glm::dvec3 ray_slope(const Cloud& cloud, std::size_t cell, int direction) const;
};

/// The grid of a station, whose place is known, and its points; empty where it has more than 64 cells a point. Of several
/// points of a cell the last counts.
[[nodiscard]] DepthGrid make_depth_grid(const Cloud& cloud, const Station& station,
                                        const std::vector<std::uint32_t>& points, const glm::dvec3& axis);

/// The median step between distinct inverse depths or, where that is more, the step that would make as much noise as there
/// is (second differences along rows). Zero of fewer than 1000 points.
[[nodiscard]] DepthUnit find_unit(const DepthGrid& grid);

/// The standard deviation of depths, as the unit gives it, over the distance to the 8th place of a square grid: the median.
[[nodiscard]] double noise_of(const Cloud& cloud, const DepthGrid& grid, const DepthUnit& unit);

}  // namespace splatray
