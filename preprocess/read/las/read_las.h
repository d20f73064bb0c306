/// Scans in LAS and LAZ files.
#pragma once
#include <filesystem>

#include "preprocess/points.h"
#include "preprocess/read/read_listener.h"

namespace splatray {

/// Reads LAS 1.0 to 1.5 with point formats 0 to 10, as they are or compressed by LASzip, COPC among them, whatever the
/// extension says. Positions are scale * integer + offset in double; z is up. Colours are as stored, of unknown scale.
/// Columns: intensity, class, return, returns, source, time, and those extra bytes that `options.scans.attributes` names;
/// those that are zero throughout are left out. Besides the points it takes a few tens of megabytes.
///
/// A file that ends early, or whose compressed parts are damaged, gives what is whole, with a note, or is refused when
/// options.scans.strict. Throws Error (input_unreadable) for what is no such file.
[[nodiscard]] ScanFile read_las(const std::filesystem::path& path, const ReadOptions& options,
                                const ReadListener& listener);

}  // namespace splatray
