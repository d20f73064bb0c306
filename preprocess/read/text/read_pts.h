/// PTS: points as text, with or without their number.
#pragma once
#include <filesystem>

#include "preprocess/points.h"
#include "preprocess/read/read_listener.h"

namespace splatray {

/// Reads a PTS file: blocks of lines x y z [intensity] [r g b [nx ny nz]] in any form of rows (cell_form.h), each block maybe after a line with the number
/// of its points; intensity as stored (-2048..2047 by convention). A number that is too low is noted, one that is too high
/// makes points count as missing, which `options.scans.strict` refuses. Files whose columns have names, numbers of rows or are
/// named by `options.scans.columns` are read as read_xyz does. Files that begin with
/// [Expe/PointSet/Binary, another format of the same extension, are read too (read_expe_points.h). Throws Error (input_unreadable) with the line, and (interrupted).
[[nodiscard]] ScanFile read_pts(const std::filesystem::path& path, const ReadOptions& options,
                                const ReadListener& listener);

}  // namespace splatray
