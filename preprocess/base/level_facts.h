/// How a file's points are in levels, for people.
#pragma once
#include <string_view>
#include <vector>

#include "preprocess/base/levels.h"
#include "preprocess/points.h"

namespace splatray {

/// Adds the counts of nodes and of points by level, the root's first, and the octree's place. Nothing without levels. `kind`: "COPC".
void add_level_facts(const Levels& levels, std::string_view kind, std::vector<FileFact>& facts);

}  // namespace splatray
