/// The surface of scans that come in grids, from these.
#pragma once
#include <cstdint>
#include <vector>

#include "preprocess/base/parallel.h"
#include "preprocess/scan/smooth/smooth.h"
#include "preprocess/surface/cloud.h"

namespace splatray {

/// What a depth camera's grid determined.
struct GridSurface {
  std::uint64_t points = 0;   ///< whose surface it determines; they are in the grid, all others are in none
  std::uint64_t normals = 0;  ///< of these, whose normals were unknown
  std::uint64_t mixed = 0;    ///< left out: between two surfaces, or on none
  std::uint64_t moved = 0;
  double moved_median_world = 0.0;
  double noise = 0.0;  ///< noise_of

  /// Whether the surface of a point is known from its grid.
  [[nodiscard]] bool has(const Cloud& cloud, std::size_t point) const {
    return points > 0 && cloud.grid_cell[point] != NO_CELL;
  }
};

/// Finds the surface where a cloud has one station alone, whose grid is a pinhole camera's (fit_pinhole) and whose depths are
/// noisy (noise_of), as their steps make them too: layers of equal depth are no surface, and no neighbourhood in space mends
/// them. Points that the plane of few cells around holds are left out as strays and mixed pixels, no others; those that stay
/// move along their lines of sight where `move` says so. Given normals and radii stay, unknown normals are those of
/// fit_planes, towards the camera; unknown radii close the grid as seen from it, up to four times as large where the
/// surface is slanted. The cloud is in order afterwards.
[[nodiscard]] GridSurface find_grid_surface(Cloud& cloud, bool move, const Stage& stage);

/// Moves the points whose normals were `estimated`, and turns these, as fit_planes has them: along their lines of sight. Only
/// where all their stations have grids and known places and, of several, no grid is clearly calmer than the points are in space
/// (`noise`, as measure_noise has it): there layers are of one surface, which smooth_points makes one of. Else nothing is
/// moved. Points that few cells around support stay. The cloud is in order afterwards.
[[nodiscard]] Smoothed smooth_by_grids(Cloud& cloud, const std::vector<std::uint8_t>& estimated, double noise,
                                       const Stage& stage);

}  // namespace splatray
