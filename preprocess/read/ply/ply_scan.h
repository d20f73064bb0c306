/// What PLY files of scanners say beside the points: range grids, and in remarks where the sensor was.
#pragma once
#include <filesystem>
#include <optional>
#include <vector>

#include "preprocess/points.h"
#include "preprocess/read/ply/ply_body.h"

namespace splatray {

/// Rows and columns of the grid that element `range_grid` lists (Stanford's scans: obj_info num_rows and num_cols), if
/// they are as many as its cells.
[[nodiscard]] std::optional<glm::uvec2> range_grid_form(const PlyHeader& header, const PlyElement& element);

/// Reads the lists of a range grid, row after row, each empty or of one vertex: sets `grid_cell` and the station's form, unless
/// the file ends before its cells. How many there are.
std::uint64_t read_range_grid(PlyBody& in, const PlyElement& element, std::size_t list,
                              const glm::uvec2& rows_columns, Points& points);

/// Sets the sensors' places that remarks "sensor x y z" or "sensor NUMBER x y z" give, where they are credible: a number
/// is that of the station so named, and a single sensor that of all points.
void place_sensors(const PlyHeader& header, Points& points);

}  // namespace splatray
