/// Entwine point tiles: a scan as an octree whose nodes are files (Hobu and Manning, Entwine Point Tile 1.0, 2019).
#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "preprocess/base/levels.h"
#include "preprocess/points.h"
#include "preprocess/read/read_listener.h"

namespace splatray {

/// The levels of an `ept.json`; empty where x and y are degrees, which become metres when the points are there. Throws Error
/// (input_unreadable), one sentence, for what is none, and for a hierarchy that is damaged: nodes named twice or without a parent, counts
/// below 0, pages that are missing.
[[nodiscard]] Levels ept_levels(const std::filesystem::path& path);

/// Reads the points of an `ept.json`, node by node as read_las does; tiles are LAZ, or records of the file's schema ("binary", "zstandard").
/// A tile that is missing or damaged gives what is whole, of a packed one nothing, with a note, or is refused when options.scans.strict. Throws Error (input_unreadable), one sentence.
[[nodiscard]] ScanFile read_ept(const std::filesystem::path& path, const ReadOptions& options,
                                const ReadListener& listener);

/// Where scanners stood: names and places of the member "stations" that splatray-preprocess writes beside EPT's own. Throws Error
/// (input_unreadable), one sentence, for others.
[[nodiscard]] std::vector<Station> read_stations(const nlohmann::json& stations,
                                                 const std::filesystem::path& path);

}  // namespace splatray
