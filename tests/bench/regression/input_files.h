/// Files that the guard's inputs are written in.
#pragma once
#include <cstdint>
#include <filesystem>
#include <vector>

#include "preprocess/points.h"
#include "tests/scan_sim/scanner.h"

namespace splatray::testing {

/// Binary PLY of float positions, and of normals where there are some. Throws Error (failed), as do the others.
void write_ply_points(const Points& points, const std::filesystem::path& path);

/// The scan with its points in PTX's order: station after station, column after column. Of grids.
[[nodiscard]] SimulatedScan in_grid_order(const SimulatedScan& scan);

/// PTX: each station's grid, cut to the rows and columns that have a return.
void write_ptx(const Points& points, const std::filesystem::path& path);

/// LAS 1.2, point format 2: positions in millimetres, intensities, classes and colours; returns 1 of 1.
void write_las_points(const Points& points, const std::filesystem::path& path);

/// OBJ: vertices and triangles.
void write_obj_mesh(const Mesh& mesh, const std::filesystem::path& path);

/// What is true of a scan's points, in their order.
struct PointTruth {
  std::vector<PointKind> kind;
  std::vector<glm::vec3> normal;  ///< unit, towards the scanner
};

/// kind.npy (bytes) and normal.npy (int16, 32767 = 1) in a folder, which is made. As NumPy 2.x keeps arrays (format 1.0).
void write_point_truth(const SimulatedScan& scan, const std::filesystem::path& folder);
/// Throws Error (input_unreadable) where the files are shorter than they say.
[[nodiscard]] PointTruth read_point_truth(const std::filesystem::path& folder);

}  // namespace splatray::testing
