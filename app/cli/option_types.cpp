#include "app/cli/option_types.h"

#include "engine/base/error.h"

namespace splatray {

void refuse_option(const std::string& option, const std::string& value, const std::string& expected) {
  throw Error(ExitCode::usage,
              option + ": found '" + value + "', expected " + expected + " (--help lists the options)");
}

std::vector<std::uint32_t> split_whole_numbers(const std::string& text, char separator, std::size_t count) {
  std::vector<std::uint32_t> whole;
  for (const double number : split_numbers(text, separator, count)) {
    if (!(number >= 0.0 && number <= SPLIT_MOST && number == std::floor(number))) return {};
    whole.push_back(static_cast<std::uint32_t>(number));
  }
  return whole;
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
      name, read, [&target] { return target ? number_text(*target) : ""; }, help, "X,Y,Z");
}

void add_text(OptionList& list, const std::string& name, std::string& target, const std::string& help,
              const std::string& value_name) {
  list.add_value(
      name, [&target](const std::string& text) { target = text; }, [&target] { return target; }, help,
      value_name);
}

void add_path(OptionList& list, const std::string& name, std::filesystem::path& target,
              const std::string& help) {
  list.add_value(
      name, [&target](const std::string& text) { target = text; }, [&target] { return target.string(); },
      help, "FILE");
}

}  // namespace splatray
