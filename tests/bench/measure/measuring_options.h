/// Command lines of the programs that measure splatray alone. By hand, as a bare GPU machine has no library for it.
#pragma once
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace splatray::testing {

/// What is done with an option's value, by the option's name.
using ValueOptions = std::map<std::string, std::function<void(const std::string&)>>;
/// What a flag sets, by its name.
using Flags = std::map<std::string, bool*>;

/// Reads FOLDER and options into what they name; false when help was asked for. Throws Error (usage), which says `expected`.
[[nodiscard]] bool parse_words(const std::vector<std::string>& words, std::filesystem::path& folder,
                               const ValueOptions& options, const Flags& flags, const std::string& expected);

/// FOLDER -o FILE.json [--quick] [--device D] [ONLY_FLAG NAME]
struct MeasuringOptions {
  std::filesystem::path folder;  ///< what splatray-bench prepare wrote
  std::filesystem::path output;
  std::string device;  ///< empty = the best
  std::string only;    ///< empty = all
  bool quick = false;
};

/// Nothing when help was asked for. `only_flag` is the option of `only`. Throws Error (usage).
[[nodiscard]] std::optional<MeasuringOptions> parse_measuring(const std::vector<std::string>& words,
                                                              const std::string& only_flag);

}  // namespace splatray::testing
