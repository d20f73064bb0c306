#include "app/cli/help_page.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>

namespace splatray {
namespace {

using Lines = std::vector<std::string>;

constexpr std::size_t SHORT_WIDTH = 80;  ///< what all terminals have

std::vector<std::string> parts_of(const std::string& text, char between) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, between);) parts.push_back(part);
  return parts;
}

/// Where a word that is too long for `width` is broken: behind the last comma or bar that fits, else where it must.
std::size_t break_of(const std::string& word, std::size_t width) {
  const std::size_t at = word.find_last_of(",|;/", width - 1);
  return at == std::string::npos || at == 0 ? width : at + 1;
}

/// The text in lines of at most `width`, broken at blanks where that is possible.
Lines wrapped(const std::string& text, std::size_t width) {
  Lines lines{""};
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (!lines.back().empty() && lines.back().size() + 1 + word.size() > width) lines.emplace_back();
    for (; word.size() > width; lines.emplace_back()) {
      const std::size_t end = break_of(word, width);
      lines.back() += word.substr(0, end);
      word.erase(0, end);
    }
    lines.back() += (lines.back().empty() ? "" : " ") + word;
  }
  return lines;
}

std::string indented(const Lines& lines, std::size_t columns) {
  std::string text;
  for (const std::string& line : lines) text += std::string(columns, ' ') + line + '\n';
  return text;
}

/// A name and what it means beside it, from column `begin` on, or below it where the name is too long.
std::string row(const std::string& name, const std::string& meaning, std::size_t begin, std::size_t width) {
  constexpr std::size_t INDENT = 2;
  const std::string right = indented(wrapped(meaning, width - begin), begin);
  if (INDENT + name.size() + 2 > begin) return indented(wrapped(name, width - INDENT), INDENT) + right;
  return std::string(INDENT, ' ') + name + right.substr(INDENT + name.size());
}

/// A command in lines that a shell takes as one.
Lines command_lines(const std::string& command, std::size_t width) {
  const std::string more = "    ", goes_on = " \\";
  Lines lines = wrapped(command, width - more.size() - goes_on.size());
  for (std::size_t i = 0; i + 1 < lines.size(); ++i) lines[i] += goes_on;
  for (std::size_t i = 1; i < lines.size(); ++i) lines[i].insert(0, more);
  return lines;
}

std::string name_and_value(const OptionEntry& entry, const std::string& value) {
  if (!entry.is_named()) return entry.name + (entry.repeated ? "..." : "");
  return entry.name + (value.empty() ? "" : " " + value);
}

/// The value for the short help: without the parts that may be left out, NAME for a list of names.
std::string short_value(const OptionEntry& entry) {
  if (entry.choices().size() > 1 && entry.choices().size() == parts_of(entry.value, '|').size())
    return "NAME";
  return entry.value.substr(0, entry.value.find('['));
}

std::string usage(const HelpPage& page) {
  std::string text = "Usage: " + page.program + " [OPTIONS]";
  for (const OptionEntry& entry : page.entries) {
    const std::string name =
        entry.is_named() ? entry.names().front() + " " + entry.value : name_and_value(entry, entry.value);
    if (entry.required)
      text += " " + name;
    else if (!entry.is_named())
      text += " [" + name + "]";
  }
  return text;
}

/// Titles in the order in which their first entries come; those of what has no name first.
Lines titles(const HelpPage& page) {
  Lines all;
  for (const OptionEntry& entry : page.entries)
    if (!entry.group.empty() && std::find(all.begin(), all.end(), entry.group) == all.end())
      all.push_back(entry.group);
  return all;
}

std::string group_text(const HelpPage& page, const std::string& title, std::size_t begin, std::size_t width) {
  std::string text;
  for (const OptionEntry& entry : page.entries)
    if (entry.group == title)
      text += row(name_and_value(entry, entry.value), entry.help + (entry.required ? "; required" : ""),
                  begin, width);
  return "\n" + title + ":\n" + text;
}

std::string examples_text(const HelpPage& page, std::size_t width, bool with_words) {
  if (page.examples.empty()) return {};
  constexpr std::size_t INDENT = 2, WORDS = 6;
  std::string text = "\nExamples:\n";
  for (const HelpExample& example : page.examples) {
    text += indented(command_lines(example.command, width - INDENT), INDENT);
    if (with_words) text += indented(wrapped(example.does, width - WORDS), WORDS);
  }
  return text;
}

std::string without_last_end(std::string text) {
  if (text.ends_with('\n')) text.pop_back();
  return text;
}

}  // namespace

std::vector<std::string> OptionEntry::names() const { return parts_of(name, ','); }

std::vector<std::string> OptionEntry::choices() const {
  std::vector<std::string> words;
  if (value.find('|') == std::string::npos) return words;
  for (const std::string& part : parts_of(value, '|'))
    if (part.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-+") == std::string::npos)
      words.push_back(part);
  return words;
}

bool OptionEntry::is_file() const { return value.starts_with("FILE"); }
bool OptionEntry::is_folder() const { return value == "FOLDER"; }

std::string short_help(const HelpPage& page) {
  constexpr std::size_t BEGIN = 28;
  std::string text = indented(wrapped(page.description, SHORT_WIDTH), 0);
  text += indented(wrapped(usage(page), SHORT_WIDTH), 0) + "\n";
  for (const OptionEntry& entry : page.entries)
    if (!entry.brief.empty())
      text += row(name_and_value(entry, short_value(entry)), entry.brief, BEGIN, SHORT_WIDTH);
  text += examples_text(page, SHORT_WIDTH, false);
  return text + "\n--help lists all options, with their ranges and defaults.";
}

std::string long_help(const HelpPage& page, std::size_t width) {
  constexpr std::size_t LEAST_WIDTH = 40, WIDE = 70, BEGIN = 28, NARROW_BEGIN = 8;
  width = std::max(width, LEAST_WIDTH);
  const std::size_t begin = width < WIDE ? NARROW_BEGIN : BEGIN;
  std::string text = indented(wrapped(page.description, width), 0);
  text += indented(wrapped(usage(page), width), 0);
  for (const std::string& title : titles(page)) text += group_text(page, title, begin, width);
  for (const HelpTable& table : page.tables) {
    text += "\n" + table.title + ":\n";
    for (const auto& [name, meaning] : table.rows) text += row(name, meaning, begin, width);
  }
  return without_last_end(text + examples_text(page, width, true));
}

std::size_t help_width() {
  constexpr std::size_t MOST = 100, USUAL = 80;
  winsize size{};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0)
    return std::min<std::size_t>(size.ws_col, MOST);
  const char* columns = std::getenv("COLUMNS");
  const unsigned long asked = columns == nullptr ? 0 : std::strtoul(columns, nullptr, 10);
  return asked > 0 ? asked : USUAL;
}

}  // namespace splatray
