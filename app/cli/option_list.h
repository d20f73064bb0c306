/// The options of a program, read from a command line. All programs that have a library for it use this list, and only
/// option_list.cpp knows the library.
#pragma once
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace splatray {

using Words = std::vector<std::string>;

/// Options by name. A name is one or more option names with commas between them ("-o,--output"), or a word without a dash for
/// what is given without a name. Where an option of one value is given twice the last one holds, so that scripts can append.
/// The functions that read a value are called while parse() runs; they refuse a value by throwing Error.
class OptionList {
 public:
  using Read = std::function<void(const std::string& value)>;

  OptionList(const std::string& description, const std::string& program);
  ~OptionList();
  OptionList(const OptionList&) = delete;
  OptionList& operator=(const OptionList&) = delete;

  /// The part of the help that options added from now on stand in; empty: the help does not show them.
  void set_group(const std::string& title);
  /// Adds an option of one value. `value_name` stands for the value in the help.
  void add_value(const std::string& name, const Read& read, const std::string& help,
                 const std::string& value_name = "TEXT");
  /// Adds an option that may be repeated: `read` is called for each of its values, in the order of the command line over all
  /// such options.
  void add_repeated(const std::string& name, const Read& read, const std::string& help,
                    const std::string& value_name);
  /// Adds files or folders: all that are given take the place of `target`. With a dashed name each needs the name before it.
  void add_paths(const std::string& name, std::vector<std::filesystem::path>& target, const std::string& help,
                 const std::string& value_name);
  /// Adds a word that stands for true.
  void add_switch(const std::string& name, bool& target, const std::string& help);
  /// Adds a word that calls `read`, with "on"; or with "on" or "off" where that is said behind an equals sign.
  void add_switch(const std::string& name, const Read& read, const std::string& help);
  /// Adds a word that is answered by a text on stdout instead of the program's work.
  void add_answer(const std::string& name, const std::function<std::string()>& answer,
                  const std::string& help);

  /// Makes an option that was added one that must be given.
  void require(const std::string& name);
  /// What the help ends with.
  void set_footer(const std::string& text);

  /// Reads a command line; the words are those after the program's name. False when help or another answer was asked for and
  /// printed. Throws Error (usage), one sentence, and what the functions that read values throw.
  [[nodiscard]] bool parse(const Words& words);
  [[nodiscard]] bool parse(int argc, char** argv);

 private:
  struct Parser;
  std::unique_ptr<Parser> parser_;
};

}  // namespace splatray
