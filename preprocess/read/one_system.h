/// Scans that do not belong together.
#pragma once
#include <vector>

#include "preprocess/read/join_scans.h"

namespace splatray {

/// Throws Error (input_unreadable), which names two of the files, where one has degrees and another lengths for x and y, or
/// where a gap more than 1000 times as wide as the scans on either side of it parts them along an axis: one scene cannot hold
/// both without blurring them, and what is in different coordinate systems lies so.
void require_one_system(const std::vector<NamedScan>& scans);

/// A file and the coordinate system that it names.
struct NamedCrs {
  std::filesystem::path path;
  std::string crs;  ///< Scene::crs
};

/// The system of all these files: that of those which name one. Where two name different ones it is unknown, and a note says so.
[[nodiscard]] std::string one_crs(const std::vector<NamedCrs>& files, std::vector<std::string>& notes);

}  // namespace splatray
