#include "app/cli/option_types.h"

#include <algorithm>

#include "engine/base/error.h"

namespace splatray {

void refuse_option(const std::string& option, const std::string& value, const std::string& expected) {
  throw CLI::ValidationError(option, "found '" + value + "', expected " + expected);
}

std::vector<double> split_numbers(const std::string& text, char separator, std::size_t count) {
  std::vector<double> numbers;
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, separator);) {
    char* end = nullptr;
    const double number = std::strtod(part.c_str(), &end);
    if (part.empty() || *end != '\0' || !std::isfinite(number)) return {};
    numbers.push_back(number);
  }
  return numbers.size() == count && text.back() != separator ? numbers : std::vector<double>{};
}

glm::dvec3 read_vector(const std::string& name, const std::string& text) {
  const auto numbers = split_numbers(text, ',', 3);
  if (numbers.empty()) refuse_option(name, text, "three numbers such as 1,-2,0.5");
  return {numbers[0], numbers[1], numbers[2]};
}

void add_vector(OptionList& list, const std::string& name, std::optional<glm::dvec3>& target,
                const std::string& help) {
  const auto read = [name, &target](const std::string& text) { target = read_vector(name, text); };
  list.add_value(
          name, read, [&target] { return target ? number_text(*target) : ""; }, help)
      ->type_name("X,Y,Z");
}

CLI::Option* add_text(OptionList& list, const std::string& name, std::string& target,
                      const std::string& help) {
  return list.add_value(
      name, [&target](const std::string& text) { target = text; }, [&target] { return target; }, help);
}

void add_path(OptionList& list, const std::string& name, std::filesystem::path& target,
              const std::string& help) {
  list.add_value(
          name, [&target](const std::string& text) { target = text; }, [&target] { return target.string(); },
          help)
      ->type_name("FILE");
}

void add_switch(OptionList& list, const std::string& name, bool& target, const std::string& help) {
  list.add_flag(name, target, help);
  list.add_words([name, &target] { return target ? Words{name} : Words{}; });
}

bool parse_options(CLI::App& app, int argc, char** argv) {
  return parse_options(app, Words(argv + std::min(argc, 1), argv + argc));
}

bool parse_options(CLI::App& app, const Words& words) {
  try {
    app.parse(Words(words.rbegin(), words.rend()));
  } catch (const CLI::Success& success) {
    app.exit(success);
    return false;
  } catch (const CLI::ParseError& error) {
    std::string sentence = error.what();
    std::replace(sentence.begin(), sentence.end(), '\n', ' ');
    throw Error(ExitCode::usage, sentence + " (--help lists the options)");
  }
  return true;
}

}  // namespace splatray
