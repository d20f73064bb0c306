/// Kinds of command-line options that the programs share. Values are read as text first, so that rubbish,
/// overflow and a wrong choice get the same sentence: the option, what was found, what was expected.
#pragma once
#include <filesystem>
#include <string>
#include <type_traits>
#include <vector>

#include "app/cli/option_list.h"
#include "app/library/request/value_text.h"

namespace splatray {

/// Throws Error (usage): the option, what was found, what was expected.
[[noreturn]] void refuse_option(const std::string& option, const std::string& value,
                                const std::string& expected);

/// The number that `text` given to option `name` is, whole for a Number that is, in [least, most]; else refuses it.
template <typename Number>
[[nodiscard]] Number read_option(const std::string& name, const std::string& text, double least,
                                 double most) {
  try {
    return static_cast<Number>(read_number(text, least, most, !std::is_floating_point_v<Number>));
  } catch (const Expected& expected) {
    refuse_option(name, text, expected.what);
  }
}

/// Any text that is not empty.
void add_text(OptionList& list, const std::string& name, std::string& target, const std::string& help,
              const std::string& value_name = "TEXT");

/// A file, or a folder where that is the value's name.
void add_path(OptionList& list, const std::string& name, std::filesystem::path& target,
              const std::string& help, const std::string& value_name = "FILE");

/// A number in [least, most].
template <typename Number>
void add_number(OptionList& list, const std::string& name, Number& target, double least, double most,
                const std::string& help) {
  const auto read = [=, &target](const std::string& text) {
    target = read_option<Number>(name, text, least, most);
  };
  list.add_value(name, read, help, std::is_floating_point_v<Number> ? "X" : "N");
}

}  // namespace splatray
