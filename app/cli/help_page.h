/// What a program says of itself: the one list of its options, of which its help, its man page and the completion of shells are made.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace splatray {

/// An option, or what is given without a name.
struct OptionEntry {
  std::string name;          ///< "-o,--output"; a word without a dash for what is given without a name
  std::string value;         ///< what stands for the value, as Field::value has it; empty: a switch
  std::string help;          ///< what it is, its unit, range and default
  std::string group;         ///< the title that it stands under; empty: neither help nor completion show it
  std::string brief{};       ///< what it is, in a few words, for the short help; empty: that does not show it
  std::string extensions{};  ///< of files that are read: with dots, a blank between; empty: any
  bool required = false, repeated = false;

  [[nodiscard]] bool is_named() const { return name.starts_with('-'); }
  /// The names with their dashes: "-o" and "--output".
  [[nodiscard]] std::vector<std::string> names() const;
  /// The words that the value may be, as far as they are known: those of "auto|off|RADIUS" are auto and off.
  [[nodiscard]] std::vector<std::string> choices() const;
  /// Whether the value, or one of several kinds of it, is a file; or a folder.
  [[nodiscard]] bool is_file() const;
  [[nodiscard]] bool is_folder() const;
};

/// A command that can be copied, and what it does.
struct HelpExample {
  std::string command, does;
};

/// Lines of a name and a text under a title.
struct HelpTable {
  std::string title;
  std::vector<std::pair<std::string, std::string>> rows{};
};

struct HelpPage {
  std::string program, description;
  std::vector<OptionEntry> entries{};
  std::vector<HelpExample> examples{};
  std::vector<HelpTable> tables{};
};

/// What -h prints: usage, the options that most people need, examples. Its lines have at most 80 columns.
[[nodiscard]] std::string short_help(const HelpPage& page);
/// What --help prints: all options in their groups, in lines of at most `width` columns, at least 40.
[[nodiscard]] std::string long_help(const HelpPage& page, std::size_t width);

/// The columns of a text on stdout: those of the terminal there, up to 100, which eyes follow; else those of the variable COLUMNS;
/// else 80.
[[nodiscard]] std::size_t help_width();

}  // namespace splatray
