/// The options of a program, read from a command line. All programs that have a library for it use this list, and only
/// option_list.cpp knows the library.
#pragma once
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/cli/help_page.h"

namespace splatray {

using Words = std::vector<std::string>;

/// Options by name. A name is one or more option names with commas between them ("-o,--output"), or a word without a dash for
/// what is given without a name. Where an option of one value is given twice the last one holds, so that scripts can append.
/// The functions that read a value are called while parse() runs; they refuse a value by throwing Error. Each list answers -h,
/// --help, --version and --completion bash, zsh or fish (completion.h) by itself.
class OptionList {
 public:
  using Read = std::function<void(const std::string& value)>;

  /// `description`: one sentence.
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
  /// Adds a word that is answered by a text on stdout instead of the program's work, whatever else is said.
  void add_answer(const std::string& name, const std::function<std::string()>& answer,
                  const std::string& help);

  /// Makes an option that was added one that must be given.
  void require(const std::string& name);
  /// Has the short help show an option that was added, with these few words.
  void set_brief(const std::string& name, const std::string& brief);
  /// The extensions of the files that an option takes, a blank between, for the completion of shells.
  void set_extensions(const std::string& name, const std::string& extensions);
  /// Three commands that people need, for the help.
  void set_examples(std::vector<HelpExample> examples);
  /// Adds lines behind the options of the help.
  void add_table(HelpTable table);
  [[nodiscard]] const HelpPage& page() const { return page_; }

  /// Reads a command line; the words are those after the program's name. False when help or another answer was asked for and
  /// printed. Throws Error (usage), one sentence, and what the functions that read values throw.
  [[nodiscard]] bool parse(const Words& words);
  [[nodiscard]] bool parse(int argc, char** argv);

 private:
  struct Parser;

  OptionEntry& entry(const std::string& name);
  /// The words, "--name=" of an option of a value as two of them: the library would take the next word for its value.
  [[nodiscard]] Words with_empty_values(const Words& words) const;
  /// The sentence about the first word that no option takes; empty where there is none.
  [[nodiscard]] std::string unknown_word() const;
  /// The sentence about the first word that is required and was not given; empty where there is none.
  [[nodiscard]] std::string missing_word() const;

  std::unique_ptr<Parser> parser_;
  HelpPage page_;
  std::string group_ = "Options";
};

}  // namespace splatray
