#include "tests/bench/measuring_options.h"

#include "engine/host/error.h"

namespace splatray::testing {

std::optional<MeasuringOptions> parse_measuring(const std::vector<std::string>& words,
                                                const std::string& only_flag) {
  MeasuringOptions options;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    const auto value = [&] {
      if (i + 1 == words.size())
        throw Error(ExitCode::usage, word + ": found nothing behind it, expected a value");
      return words[++i];
    };
    if (word == "-h" || word == "--help") return {};
    if (word == "--quick") {
      options.quick = true;
    } else if (word == "-o" || word == "--output") {
      options.output = value();
    } else if (word == "--device") {
      options.device = value();
    } else if (word == only_flag) {
      options.only = value();
    } else if (!word.starts_with('-') && options.folder.empty()) {
      options.folder = word;
    } else {
      throw Error(ExitCode::usage,
                  "found '" + word + "', expected FOLDER -o FILE.json (--help lists the options)");
    }
  }
  if (options.folder.empty() || options.output.empty())
    throw Error(ExitCode::usage,
                "found no FOLDER or no -o FILE.json, expected both (--help lists the options)");
  return options;
}

}  // namespace splatray::testing
