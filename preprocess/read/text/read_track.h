/// Where a sensor moved, as text.
#pragma once
#include <filesystem>
#include <vector>

#include "preprocess/points.h"
#include "preprocess/read/read_listener.h"

namespace splatray {

/// Reads a text file of times and places as read_xyz does, by its header or else as columns time, x, y, z; by time. Throws Error
/// (input_unreadable) where it has no place or times that are all one.
[[nodiscard]] std::vector<TrackPlace> read_track(const std::filesystem::path& path,
                                                 const ReadListener& listener);

}  // namespace splatray
