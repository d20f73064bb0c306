/// Sweeps as the data sets KITTI and nuScenes store them.
#pragma once
#include <filesystem>

#include "preprocess/points.h"
#include "preprocess/read/read_listener.h"

namespace splatray {

/// Reads a sweep of float32 x y z reflectance without a header (Geiger et al. 2013, "Vision meets Robotics: The KITTI
/// Dataset", sec. II-B), or of these and the number of a ring (Caesar et al. 2020, "nuScenes: A Multimodal Dataset for Autonomous
/// Driving"), which `options.scans.attributes` may ask for as "ring": metres in the frame of the sensor, which stands at the
/// origin, z up. As nothing in such a file says what it is, it is refused unless all its bytes are points that are finite, within
/// a kilometre, and of a reflectance of 0 to 255. Throws Error (input_unreadable), and (interrupted).
[[nodiscard]] ScanFile read_kitti(const std::filesystem::path& path, const ReadOptions& options,
                                  const ReadListener& listener);

}  // namespace splatray
