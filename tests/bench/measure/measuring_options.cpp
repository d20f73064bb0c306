#include "tests/bench/measure/measuring_options.h"

#include "engine/base/error.h"

namespace splatray::testing {

bool parse_words(const std::vector<std::string>& words, std::filesystem::path& folder,
                 const ValueOptions& options, const Flags& flags, const std::string& expected) {
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    if (word == "-h" || word == "--help") return false;
    if (const auto option = options.find(word); option != options.end()) {
      if (i + 1 == words.size())
        throw Error(ExitCode::usage, word + ": found nothing behind it, expected a value");
      option->second(words[++i]);
    } else if (const auto flag = flags.find(word); flag != flags.end()) {
      *flag->second = true;
    } else if (!word.starts_with('-') && folder.empty()) {
      folder = word;
    } else {
      throw Error(ExitCode::usage,
                  "found '" + word + "', expected " + expected + " (--help lists the options)");
    }
  }
  return true;
}

std::optional<MeasuringOptions> parse_measuring(const std::vector<std::string>& words,
                                                const std::string& only_flag) {
  MeasuringOptions options;
  const auto output = [&](const std::string& value) { options.output = value; };
  const ValueOptions values{{"-o", output},
                            {"--output", output},
                            {"--device", [&](const std::string& value) { options.device = value; }},
                            {only_flag, [&](const std::string& value) { options.only = value; }}};
  if (!parse_words(words, options.folder, values, {{"--quick", &options.quick}}, "FOLDER -o FILE.json"))
    return {};
  if (options.folder.empty() || options.output.empty())
    throw Error(ExitCode::usage,
                "found no FOLDER or no -o FILE.json, expected both (--help lists the options)");
  return options;
}

}  // namespace splatray::testing
