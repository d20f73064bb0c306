/// Virtual point clouds: lists of the files that make up a survey (PDAL wrench and QGIS, virtual point cloud 1.0, 2023: a feature
/// collection of STAC items).
#pragma once
#include <filesystem>
#include <vector>

namespace splatray {

/// The files of points that a list names, in its order, places in them relative to its own; those of overviews, whose points the others
/// have, too, are left out. Throws Error (input_unreadable), one sentence, for what is no such list, and for one that names no file.
[[nodiscard]] std::vector<std::filesystem::path> read_vpc(const std::filesystem::path& path);

}  // namespace splatray
