/// Values that stand for "no data" among coordinates.
#pragma once
#include <filesystem>

#include "preprocess/points.h"
#include "preprocess/read/read_listener.h"

namespace splatray {

/// Leaves out, as points without a position (`counts`), those that share a coordinate exactly which is far from that of all
/// others: more than three times the longest side of the others' box, or, of the values that programs write for "no data"
/// (-9999 and the like, the least integers of 16 and 32 bits, 1e10 and more), more than their range along that axis. There must be
/// two of these and three others. Each value is noted. Positions must be finite.
void remove_no_data(const std::filesystem::path& path, Points& points, ScanCounts& counts,
                    const ReadListener& listener);

}  // namespace splatray
