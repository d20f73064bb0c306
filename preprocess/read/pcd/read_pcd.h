/// PCD, the Point Cloud Library's files.
#pragma once
#include <filesystem>

#include "preprocess/points.h"
#include "preprocess/read/read_listener.h"

namespace splatray {

/// Reads a PCD file, ascii, binary or binary_compressed. Fields: x y z, rgb or rgba packed in four bytes (also of type F,
/// and as the text of such a float), normal_x normal_y normal_z, intensity, and the ones of single values that
/// `options.scans.attributes` names; the others are named in a note. Points stay as they are stored: VIEWPOINT only gives
/// the sensor's place, where it is credible and not the default of a cloud without a grid, which says nothing. HEIGHT > 1
/// makes a station with a grid. Points whose position is not finite are counted as no_return. z is up, but for a grid in
/// a camera's frame (z ahead, y down). Points that the file ends before are missing; `options.scans.strict` refuses such
/// files. Throws Error (input_unreadable) with what was found, and (interrupted).
[[nodiscard]] ScanFile read_pcd(const std::filesystem::path& path, const ReadOptions& options,
                                const ReadListener& listener);

}  // namespace splatray
