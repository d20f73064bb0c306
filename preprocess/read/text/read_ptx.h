/// PTX: scans as text, in their grids.
#pragma once
#include <filesystem>

#include "preprocess/points.h"
#include "preprocess/read/read_listener.h"

namespace splatray {

/// Reads the scans of a PTX file (Leica Geosystems, "PTX format"), one station each. A scan is ten lines, the number of
/// columns, of rows, the scanner's position, its three axes and the four rows of a transform, then a line for each cell,
/// column after column: x y z in the scanner's frame, intensity 0..1 and maybe r g b. Row vectors times the transform are
/// world positions. 0 0 0 is a cell without a return. Where the lines are not as many as the cells, those there are make
/// points without a grid, with a note; `options.scans.strict` refuses fewer. The scanner's place is the transform's origin,
/// or the header's position where that origin is zero, if credible. Throws Error (input_unreadable) with the line, and (interrupted).
[[nodiscard]] ScanFile read_ptx(const std::filesystem::path& path, const ReadOptions& options,
                                const ReadListener& listener);

}  // namespace splatray
