/// E57 (ASTM E2807-11): scans with poses, grids, colours and intensity.
#pragma once
#include "preprocess/points.h"
#include "preprocess/read/read_listener.h"

namespace splatray {

/// All scans of the file, each a station, in world coordinates (its pose applied, in double). Records whose invalid state is
/// not 0 and those without finite coordinates are counted as no returns; so are points at the scanner's very place where
/// they are many (ScanDecoder::finish). Colours are brought to 0..255 by the scan's limits where its values fit them
/// (scan_colors.h). Intensity is as stored. Normals of the extension E57_NOR are turned by the pose. A file that ends
/// early gives what is there, with a note. Images are not read. Throws Error (input_unreadable) for what is no such file, for a page that does not match its checksum (unless
/// options.scans.ignore_checksums) and for missing records (where options.scans.strict); or (interrupted).
[[nodiscard]] ScanFile read_e57(const std::filesystem::path& path, const ReadOptions& options,
                                const ReadListener& listener);

}  // namespace splatray
