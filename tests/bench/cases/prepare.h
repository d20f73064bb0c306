/// Makes what splatray-bench needs of a case: scene files, camera and truth.
#pragma once
#include <filesystem>

#include "tests/bench/cases/cases.h"

namespace splatray::testing {

/// Where the sources of a case's points are.
struct Folders {
  std::filesystem::path repository;  ///< with data/scenes
  std::filesystem::path data;        ///< with models and env (SPLATRAY_DATA_DIR); empty = none
  std::filesystem::path output;      ///< each case gets a folder in it, and `points` holds generated points
};

/// Why the case cannot be made, as a phrase; empty when it can: it needs the data folder or Embree, and there is none.
[[nodiscard]] std::string reason_to_leave_out(const Case& one, const Folders& folders);

/// Writes the case's folder. Throws Error.
void prepare_case(const Case& one, const Folders& folders);

}  // namespace splatray::testing
