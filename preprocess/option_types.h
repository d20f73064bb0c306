/// Kinds of command-line options that the programs share. Values are read as text first, so that rubbish,
/// overflow and a wrong choice get the same sentence: the option, what was found, what was expected.
#pragma once
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdlib>
#include <glm/glm.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <type_traits>
#include <vector>

namespace splatray {

[[noreturn]] void refuse_option(const std::string& option, const std::string& value,
                                const std::string& expected);

/// Finite numbers separated by `separator`, exactly `count` of them; empty when the text is anything else.
[[nodiscard]] std::vector<double> split_numbers(const std::string& text, char separator, std::size_t count);

/// Three numbers, X,Y,Z.
void add_vector(CLI::App& app, const std::string& name, std::optional<glm::dvec3>& target,
                const std::string& help);

/// A number in [least, most].
template <typename Number>
void add_number(CLI::App& app, const std::string& name, Number& target, double least, double most,
                const std::string& help) {
  app.add_option_function<std::string>(
         name,
         [=, &target](const std::string& text) {
           const auto numbers = split_numbers(text, ',', 1);
           const bool whole =
               std::is_floating_point_v<Number> || (!numbers.empty() && numbers[0] == std::floor(numbers[0]));
           if (numbers.empty() || !whole || !(numbers[0] >= least && numbers[0] <= most)) {
             std::ostringstream expected;
             expected.precision(12);
             expected << (std::is_floating_point_v<Number> ? "a number" : "a whole number") << " from "
                      << least << " to " << most;
             refuse_option(name, text, expected.str());
           }
           target = static_cast<Number>(numbers[0]);
         },
         help)
      ->type_name(std::is_floating_point_v<Number> ? "X" : "N");
}

/// A name and what it stands for.
template <typename Value>
struct Choice {
  std::string name;
  Value value;
};

/// One of a few names.
template <typename Value>
void add_choice(CLI::App& app, const std::string& name, Value& target,
                const std::vector<Choice<Value>>& choices, const std::string& help) {
  std::string names;
  for (const auto& choice : choices) names += (names.empty() ? "" : "|") + choice.name;
  app.add_option_function<std::string>(
         name,
         [=, &target](const std::string& text) {
           for (const auto& choice : choices)
             if (text == choice.name) return void(target = choice.value);
           refuse_option(name, text, "one of " + names);
         },
         help)
      ->type_name(names);
}

/// Parses the command line. False when help or the version was asked for and printed. Throws Error (usage),
/// one sentence.
[[nodiscard]] bool parse_options(CLI::App& app, int argc, char** argv);

}  // namespace splatray
