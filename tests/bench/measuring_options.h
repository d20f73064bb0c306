/// Command lines of the programs that measure splatray alone. By hand, as a bare GPU machine has no library for it.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace splatray::testing {

/// FOLDER -o FILE.json [--quick] [--device D] [ONLY_FLAG NAME]
struct MeasuringOptions {
  std::filesystem::path folder;  ///< what splatray-bench-prepare wrote
  std::filesystem::path output;
  std::string device;  ///< empty = the best
  std::string only;    ///< empty = all
  bool quick = false;
};

/// Nothing when help was asked for. `only_flag` is the option of `only`. Throws Error (usage).
[[nodiscard]] std::optional<MeasuringOptions> parse_measuring(const std::vector<std::string>& words,
                                                              const std::string& only_flag);

}  // namespace splatray::testing
