/// The options of a program: read from a command line, and written as one.
#pragma once
#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

namespace splatray {

using Words = std::vector<std::string>;

/// A CLI::App whose options also know their words. Where an option is given twice the last one holds, so that scripts can
/// append.
class OptionList : public CLI::App {
 public:
  OptionList(const std::string& description, const std::string& program);

  /// Adds the words of an option, or of several: `words` gives them for the values that the options are bound to now.
  void add_words(std::function<Words()> words);
  /// Adds an option of one value. `write` gives its text now, empty = unset.
  CLI::Option* add_value(const std::string& name, std::function<void(const std::string&)> read,
                         std::function<std::string()> write, const std::string& help);

  /// The words of all options whose words are not what they were when added, in the order of adding. Parsed, they bring
  /// the bound values from what they were then to what they are now.
  [[nodiscard]] Words changed_words() const;

 private:
  struct Writer {
    std::function<Words()> words;
    Words initial;
  };
  std::vector<Writer> writers_;
};

}  // namespace splatray
