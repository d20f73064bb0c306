/// Points as lines of text: XYZ, CSV, TXT, ASC.
#pragma once
#include <filesystem>

#include "preprocess/points.h"
#include "preprocess/read/read_listener.h"

namespace splatray {

/// Reads points of one line each. Separator, header, count and comments are found (text_layout.h), columns without names
/// guessed (unnamed_columns.h); a first one that counts all rows is left out. Columns of normals, colours (stored_colors.h),
/// radius, intensity, class, return, returns, source, time, and those that `options.scans` names; `scan` makes a station of each of
/// its numbers. Cells behind the last named column are passed over. Points without a finite position are counted as
/// no_return; columns that are not used, and longitudes and latitudes, are noted. A count that is too high makes points
/// missing, which `options.scans.strict` refuses. A file that begins as a raster grid is read as one (read_esri_grid.h).
/// Throws Error (input_unreadable) with the line, and (interrupted).
[[nodiscard]] ScanFile read_xyz(const std::filesystem::path& path, const ReadOptions& options,
                                const ReadListener& listener);

}  // namespace splatray
