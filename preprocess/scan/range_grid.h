/// The grid of a structured scan: what a scanner saw beside each point.
#pragma once
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "preprocess/surface/cloud.h"

namespace splatray {

/// The most cells of a grid for each of its points: no allocation that the points do not justify.
inline constexpr std::uint64_t MOST_CELLS_PER_POINT = 64;

/// The points of one station by their cells.
class RangeGrid {
 public:
  /// `points` are those of the station. Is empty where it has no grid, its sensor is not known, or its grid has more than 64
  /// cells a point.
  RangeGrid(const Cloud& cloud, const Station& station, const std::vector<std::uint32_t>& points);

  [[nodiscard]] bool empty() const { return point_.empty(); }
  /// The point `rows` and `columns` beside this one, NO_CELL where nothing returned. The last column's next is the first.
  [[nodiscard]] std::uint32_t beside(std::uint32_t point, int rows, int columns) const;
  /// Distance from the sensor, cloud coordinates.
  [[nodiscard]] double range(std::uint32_t point) const;

  /// How far the point lies, along its line of sight, from the straight lines through the next two points in each of the 8
  /// directions of the grid; +inf where one is missing. Inverse ranges of a plane are linear in small angles.
  [[nodiscard]] std::array<float, 8> off_lines(std::uint32_t point) const;

 private:
  const Cloud& cloud_;
  std::int64_t rows_ = 0, columns_ = 0;
  glm::dvec3 sensor_{0.0};
  std::vector<std::uint32_t> point_;  ///< by cell
};

}  // namespace splatray
