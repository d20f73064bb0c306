/// What a render did, as JSON for people and scripts.
#pragma once
#include "app/library/picture/series/make.h"

namespace splatray {

/// Times of the program's own stages, milliseconds.
struct StageTimes {
  double device_ms = 0.0, upload_ms = 0.0;
  /// Time of the preview that the exposure is taken from, its program's building included.
  double exposure_ms = 0.0;
};

/// Writes the file that the options name: device, scene, picture, times per stage, bytes per pool, and rays by class,
/// steps and tests when counted; of a sequence the sums, and the times of each frame. Throws Error (failed); leaves no
/// partial file.
void write_stats(const Shot& shot, const LoadedScene& loaded, const PoolCounts& counts, const Device& device,
                 const PoolBytes& bytes, const StageTimes& times, const SequenceRecord& record);

}  // namespace splatray
