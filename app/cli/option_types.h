/// Kinds of command-line options that the programs share. Values are read as text first, so that rubbish,
/// overflow and a wrong choice get the same sentence: the option, what was found, what was expected.
#pragma once
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <type_traits>
#include <vector>

#include "app/cli/option_list.h"
#include "engine/base/number_text.h"

namespace splatray {

/// Throws Error (usage): the option, what was found, what was expected.
[[noreturn]] void refuse_option(const std::string& option, const std::string& value,
                                const std::string& expected);

/// Whole numbers from 0 to SPLIT_MOST, such as pixels of a side, as split_numbers has them; empty when the text is anything else.
inline constexpr double SPLIT_MOST = 32768.0;
[[nodiscard]] std::vector<std::uint32_t> split_whole_numbers(const std::string& text, char separator,
                                                             std::size_t count);

/// The three numbers that `text` given to option `name` is; else refuses it.
[[nodiscard]] glm::dvec3 read_vector(const std::string& name, const std::string& text);

/// Three numbers, X,Y,Z.
void add_vector(OptionList& list, const std::string& name, std::optional<glm::dvec3>& target,
                const std::string& help);

/// Any text that is not empty.
void add_text(OptionList& list, const std::string& name, std::string& target, const std::string& help,
              const std::string& value_name = "TEXT");

/// A file or folder.
void add_path(OptionList& list, const std::string& name, std::filesystem::path& target,
              const std::string& help);

/// The number that `text` given to option `name` is, whole for a Number that is, in [least, most]; else refuses it.
template <typename Number>
[[nodiscard]] Number read_number(const std::string& name, const std::string& text, double least,
                                 double most) {
  const auto numbers = split_numbers(text, ',', 1);
  const bool whole =
      std::is_floating_point_v<Number> || (!numbers.empty() && numbers[0] == std::floor(numbers[0]));
  if (numbers.empty() || !whole || !(numbers[0] >= least && numbers[0] <= most)) {
    std::ostringstream expected;
    expected.precision(12);
    expected << (std::is_floating_point_v<Number> ? "a number" : "a whole number") << " from " << least
             << " to " << most;
    refuse_option(name, text, expected.str());
  }
  return static_cast<Number>(numbers[0]);
}

/// A number in [least, most].
template <typename Number>
void add_number(OptionList& list, const std::string& name, Number& target, double least, double most,
                const std::string& help) {
  const auto read = [=, &target](const std::string& text) {
    target = read_number<Number>(name, text, least, most);
  };
  const auto write = [&target]() -> std::string {
    if constexpr (std::is_floating_point_v<Number>)
      return number_text(target);
    else
      return std::to_string(target);
  };
  list.add_value(name, read, write, help, std::is_floating_point_v<Number> ? "X" : "N");
}

/// A name and what it stands for.
template <typename Value>
struct Choice {
  std::string name;
  Value value;
};

/// One of a few names.
template <typename Value>
void add_choice(OptionList& list, const std::string& name, Value& target,
                const std::vector<Choice<Value>>& choices, const std::string& help) {
  std::string names;
  for (const auto& choice : choices) names += (names.empty() ? "" : "|") + choice.name;
  const auto read = [=, &target](const std::string& text) {
    for (const auto& choice : choices)
      if (text == choice.name) return void(target = choice.value);
    refuse_option(name, text, "one of " + names);
  };
  const auto write = [=, &target]() -> std::string {
    for (const auto& choice : choices)
      if (target == choice.value) return choice.name;
    return "";
  };
  list.add_value(name, read, write, help, names);
}

}  // namespace splatray
