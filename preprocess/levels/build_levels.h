/// The second and the last step towards levels: parts become nodes, and nodes above them are added.
#pragma once
#include "engine/base/progress.h"
#include "preprocess/levels/level_folder.h"

namespace splatray {

/// Builds the nodes of a part whose points are divided, unless it is built: at most `most_points` at once, in memory. Where one place has
/// more, means there are of so many of them.
void build_part(const LevelJob& job, std::size_t part, std::uint64_t most_points, const LevelFolder& folder);

/// Makes the nodes above the parts, all of which are built, and returns all nodes. May be called again when it was interrupted.
[[nodiscard]] BuiltNodes join_parts(const LevelJob& job, const LevelFolder& folder, const Progress& progress);

}  // namespace splatray
