/// What a build did, for people and for scripts.
#pragma once
#include <filesystem>
#include <string>

#include "preprocess/build.h"

namespace splatray {

/// All counts and times as a JSON object.
[[nodiscard]] std::string build_stats_json(const BuildStats& stats);

/// A few lines: points, repairs, octree, growth, overlap, bytes, times. `path` is the written scene file.
[[nodiscard]] std::string build_summary(const BuildStats& stats, const std::filesystem::path& path);

}  // namespace splatray
