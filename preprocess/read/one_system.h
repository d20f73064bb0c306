/// Scans that do not belong together.
#pragma once
#include <vector>

#include "preprocess/read/join_scans.h"

namespace splatray {

/// Throws Error (input_unreadable), which names two of the files, where one has degrees and another lengths for x and y, or
/// where a gap more than 1000 times as wide as the scans on either side of it parts them along an axis: one scene cannot hold
/// both without blurring them, and what is in different coordinate systems lies so.
void require_one_system(const std::vector<NamedScan>& scans);

}  // namespace splatray
