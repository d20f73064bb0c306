/// Point sets of the Expe tools, whose files are named .pts too.
#pragma once
#include <filesystem>

#include "preprocess/points.h"
#include "preprocess/read/read_listener.h"

namespace splatray {

/// Whether a file begins like one: "[Expe/PointSet/Binary". Throws as ByteReader does.
[[nodiscard]] bool is_expe_points(const std::filesystem::path& path);

/// Reads such a file: lines `property NAME BYTES` (position 12, radius 4 and normal 12 of floats, color 4 of red, green,
/// blue and alpha; others are passed over), `nofpoints COUNT` and `data`, then the points. y is up. Points that the file
/// ends before count as missing. Throws Error (input_unreadable), and (interrupted).
[[nodiscard]] ScanFile read_expe_points(const std::filesystem::path& path, const ReadOptions& options,
                                        const ReadListener& listener);

}  // namespace splatray
