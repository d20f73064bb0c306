#include "preprocess/option_types.h"

#include <algorithm>

#include "engine/host/error.h"

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

void add_vector(CLI::App& app, const std::string& name, std::optional<glm::dvec3>& target,
                const std::string& help) {
  app.add_option_function<std::string>(
         name,
         [name, &target](const std::string& text) {
           const auto numbers = split_numbers(text, ',', 3);
           if (numbers.empty()) refuse_option(name, text, "three numbers such as 1,-2,0.5");
           target = glm::dvec3(numbers[0], numbers[1], numbers[2]);
         },
         help)
      ->type_name("X,Y,Z");
}

bool parse_options(CLI::App& app, int argc, char** argv) {
  try {
    app.parse(argc, argv);
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
