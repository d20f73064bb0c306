/// The first step towards levels: points go into files of parts.
#pragma once
#include "engine/base/progress.h"
#include "preprocess/levels/level_folder.h"
#include "preprocess/levels/point_batches.h"

namespace splatray {

/// Counts the points of all batches and divides them into parts of at most `most_part_points`, unless one of 2^20 cells alone has more.
/// Throws Error (input_unreadable) where there are none.
[[nodiscard]] LevelJob plan_levels(PointBatches& batches, std::uint64_t most_part_points,
                                   const Progress& progress);

/// Appends the records of those batches that have not been divided yet to the files of the job's parts.
void divide_points(PointBatches& batches, const LevelJob& job, const LevelFolder& folder,
                   const Progress& progress);

}  // namespace splatray
