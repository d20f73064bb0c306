/// Which nodes of scans in levels a picture needs.
#pragma once
#include <vector>

#include "engine/image/view.h"
#include "preprocess/base/levels.h"

namespace splatray {

/// What of the nodes the pictures see, and how finely.
struct LevelCut {
  std::vector<View> views;                                                ///< pictures, or windows of them
  double spacing_px = 1.0;                                                ///< of the points chosen; 0: all
  std::uint64_t most_points = std::numeric_limits<std::uint64_t>::max();  ///< with means (LoadCount)
  /// How much wider the spacing may be of what no picture shows: it is met by shadows, reflections and the sky's light alone. Infinite:
  /// nothing of it.
  double unseen_factor = 8.0;
  double z_scale = 1.0;  ///< factor on the heights of the files' points (ScanOptions::z_scale)
};

struct CutLevels {
  std::vector<std::vector<std::uint32_t>> nodes;  ///< of each file, ascending
  double spacing_px = 0.0;                        ///< that they are chosen by
};

/// The nodes of all files: from the roots down those in which the points of the nodes above lie further apart than
/// `spacing_px` in the picture that shows them nearest. Of an ancestor's points a node is taken to have an even share among the children.
/// Where these are more than `most_points`, those are left out whose points would lie nearest to each other: what is chosen is that of the
/// least spacing with so few; the roots that are seen, or all of a finite `unseen_factor`, are always there. A function of directories and views alone.
[[nodiscard]] CutLevels cut_levels(const std::vector<Levels>& files, const LevelCut& cut);

}  // namespace splatray
