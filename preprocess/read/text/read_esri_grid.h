/// ESRI's ASCII grids: rasters of heights as text.
#pragma once
#include <filesystem>

#include "preprocess/points.h"
#include "preprocess/read/read_listener.h"

namespace splatray {

/// Whether a file begins like one, with a line "ncols" or "nrows" and a number, in any case. Throws as ByteReader does.
[[nodiscard]] bool is_esri_grid(const std::filesystem::path& path);

/// Reads such a file: lines of a key and a number (ncols, nrows, xllcorner or xllcenter, yllcorner or yllcenter, cellsize or
/// dx and dy, maybe NODATA_value, which is -9999 elsewhere), then the heights, row by row from the top, on any lines. Each
/// cell makes a point in its middle; those without data are counted as no_return. Cells that the file ends before are missing,
/// which `options.scans.strict` refuses. Throws Error (input_unreadable) with the line, and (interrupted).
[[nodiscard]] ScanFile read_esri_grid(const std::filesystem::path& path, const ReadOptions& options,
                                      const ReadListener& listener);

}  // namespace splatray
