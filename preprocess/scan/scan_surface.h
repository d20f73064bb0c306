/// The surface of a scan: its normals, without what is no surface, and without noise.
#pragma once
#include "preprocess/base/parallel.h"
#include "preprocess/surface/cloud.h"

namespace splatray {

/// Repairs the points of a cloud that was measured (no points of a mesh): those of depth cameras by their grids
/// (find_grid_surface). Of others, strays are dropped (find_strays), unknown normals estimated (survey_points), the scanner's place found where a
/// room shows it (find_scanner_place), surfaces laid through lines (find_lines, join_lines), what is on no surface recognised (find_kinds) and shown as small discs
/// (make_scatter_discs), other normals turned (turn_to_sides), and where these show noise, their points are smoothed
/// (smooth_points); all of surfaces are where params.smooth_world asks for it. Each station learns how noisy its points were and in what steps they came. What has normals, or is clean, stays as it is. `up`
/// is unit. Adds to the counts of `stats`; returns the number of estimated normals.
std::uint64_t find_scan_surface(Cloud& cloud, const glm::dvec3& up, const BuildParams& params,
                                const Stage& stage, BuildStats& stats);

}  // namespace splatray
