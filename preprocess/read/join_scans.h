/// Many files of one survey are one object.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "preprocess/points.h"

namespace splatray {

/// One scan's file and what it is called.
struct NamedScan {
  std::string name;
  ScanFile file;
  std::filesystem::path path{};  ///< for messages
};

/// The object of all scans, in their order: stations follow one another, attributes that a file lacks are 0 there, and the
/// column COLUMN_SCAN numbers the stations where there are several. Stored colours become linear ones: those whose scale is
/// not known are 8-bit where no file of such has a value above 255, and none at all where all of them are zero.
[[nodiscard]] InputObject join_scans(std::vector<NamedScan> scans);

}  // namespace splatray
