/// Files that hold less than they say.
#pragma once
#include <filesystem>

#include "preprocess/points.h"
#include "preprocess/read/read_listener.h"

namespace splatray {

/// Says how many points a file is short of, where it is; throws Error (input_unreadable) where `options.strict` asks for it.
void report_missing(const std::filesystem::path& path, const ScanCounts& counts, const ScanOptions& options,
                    const ReadListener& listener);

}  // namespace splatray
