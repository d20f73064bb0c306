/// What a request's pictures need of files in levels.
#pragma once
#include <filesystem>
#include <vector>

#include "app/library/request/request.h"
#include "engine/image/view.h"
#include "preprocess/base/levels.h"
#include "preprocess/points.h"

namespace splatray {

/// The files of a request that are in levels.
struct InLevels {
  std::vector<std::filesystem::path> paths;
  std::vector<Levels> levels;

  [[nodiscard]] std::uint64_t points() const;
  /// Those of the nodes of all files.
  [[nodiscard]] std::uint64_t points(const ChosenNodes& nodes) const;
  /// With the means that stand for nodes below these: what must fit into memory.
  [[nodiscard]] std::uint64_t loaded(const ChosenNodes& nodes) const;
};

/// None where all points are to be read, as those of small scans are. Throws Error (input_unreadable).
[[nodiscard]] InLevels in_levels(const Request& request);

/// The levels that show what a scan is, as many in all requests of it.
[[nodiscard]] ChosenNodes overview_of(const InLevels& files);

/// Nodes, and the spacing of their points in pixels that they are chosen by.
struct NeededNodes {
  ChosenNodes nodes;
  double lod = 0.0;
};

/// Those that these pictures need by the request's spacing and memory (level_cut.h).
[[nodiscard]] NeededNodes needed_nodes(const Request& request, const std::vector<View>& views,
                                       const InLevels& files);

/// A sentence on how many points are read, and whether that is what the pictures need or what memory holds.
[[nodiscard]] std::string read_note(const Request& request, const InLevels& files, const NeededNodes& needed);

/// These nodes and all that parts of pictures show. Throws Error (out_of_memory) for more points than the request's memory holds.
[[nodiscard]] ChosenNodes with_all_seen(const Request& request, const std::vector<View>& parts,
                                        const InLevels& files, const ChosenNodes& nodes);

}  // namespace splatray
