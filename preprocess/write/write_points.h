/// Files of points: a scene's splats with all their attributes, for other programs and to be read again.
#pragma once
#include <filesystem>
#include <string>

#include "engine/base/progress.h"
#include "preprocess/write/point_table.h"

namespace splatray {

/// Whether the extension is one of those that write_points writes: .ply, .las, .csv or .vtp. Throws Error (usage) for .laz and
/// other formats of points, which are only read.
[[nodiscard]] bool is_point_output(const std::filesystem::path& path);

/// What is not in a file of such points though the scene has it, one sentence; empty where that is nothing.
[[nodiscard]] std::string lost_by_format(const Scene& scene, const std::filesystem::path& path);

/// Writes the points in the format of the extension, whole or not at all:
/// - .ply, binary: float64 positions, all properties. Read again, splats of one object are the same bits: normal fields and clip
///   lines are there as words (splat_field, splat_clip), the lattice, up direction, scans and coordinate system as comments.
/// - .las 1.4: coordinates on the scene's lattice; intensity, class, return, returns, source and time where LAS has them, all
///   others as extra bytes; the coordinate system as text or keys.
/// - .csv: a line of names, then a line a point, numbers in the shortest form that reads as the same bits.
/// - .vtp: VTK's XML, arrays appended raw, one vertex a point; what .ply has as comments is field data. Read again, the same bits.
/// Throws Error (failed) where the file cannot be written or cannot hold the points, (interrupted) as `progress` says, called
/// with the stage "writing".
void write_points(const PointTable& table, const std::filesystem::path& path, const Progress& progress);

}  // namespace splatray
