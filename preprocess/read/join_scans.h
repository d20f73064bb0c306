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
/// not known are judged from all files of such (ColorRange), and none at all where all of them are zero. What was taken for
/// granted about them goes to `notes`. Attributes that are zero throughout are left out, but for those that `asked` names.
[[nodiscard]] InputObject join_scans(std::vector<NamedScan> scans, std::vector<std::string>& notes,
                                     const std::vector<std::string>& asked = {});

}  // namespace splatray
