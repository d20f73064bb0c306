/// The options of a program: read from a command line, and written as one. All programs that have a library for it use this
/// list, and only option_list.cpp knows the library.
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
  using Write = std::function<std::string()>;

  OptionList(const std::string& description, const std::string& program);
  ~OptionList();
  OptionList(const OptionList&) = delete;
  OptionList& operator=(const OptionList&) = delete;

  /// Adds an option of one value. `write` gives its text now, empty = unset; with no `write` the option has no words.
  /// `value_name` stands for the value in the help.
  void add_value(const std::string& name, const Read& read, const Write& write, const std::string& help,
                 const std::string& value_name = "TEXT");
  /// Adds an option that may be repeated: `read` is called for each of its values, in the order of the command line over all
  /// such options. It has no words.
  void add_repeated(const std::string& name, const Read& read, const std::string& help,
                    const std::string& value_name);
  /// Adds files or folders: all that are given take the place of `target`. With a dashed name each needs the name before it.
  /// They have no words.
  void add_paths(const std::string& name, std::vector<std::filesystem::path>& target, const std::string& help,
                 const std::string& value_name);
  /// Adds a word that stands for true.
  void add_switch(const std::string& name, bool& target, const std::string& help);
  /// Adds a word that is answered by a text on stdout instead of the program's work.
  void add_answer(const std::string& name, const Write& answer, const std::string& help);
  /// Adds the words of an option, or of several: `words` gives them for the values that the options are bound to now.
  void add_words(std::function<Words()> words);

  /// Makes an option that was added one that must be given.
  void require(const std::string& name);
  /// What the help ends with.
  void set_footer(const std::string& text);
  /// Takes --help away.
  void remove_help();

  /// Reads a command line; the words are those after the program's name. False when help or another answer was asked for and
  /// printed. Throws Error (usage), one sentence, and what the functions that read values throw.
  [[nodiscard]] bool parse(const Words& words);
  [[nodiscard]] bool parse(int argc, char** argv);

  /// The words of all options whose words are not what they were when added, in the order of adding. Parsed, they bring
  /// the bound values from what they were then to what they are now.
  [[nodiscard]] Words changed_words() const;

 private:
  struct Writer {
    std::function<Words()> words;
    Words initial;
  };
  struct Parser;
  std::unique_ptr<Parser> parser_;
  std::vector<Writer> writers_;
};

}  // namespace splatray
