#include "app/cli/command_line.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "app/cli/option_list.h"
#include "engine/base/error.h"

namespace splatray {
namespace {

constexpr const char* PROGRAM = "splatray-render";

/// Reads the text after an opening quote up to its end, which it skips.
std::string quoted_part(const std::string& text, std::size_t& at, char quote) {
  std::string part;
  for (; at < text.size() && text[at] != quote; ++at) {
    const bool escaped = quote == '"' && text[at] == '\\' && at + 1 < text.size() &&
                         std::string("\\\"$`").find(text[at + 1]) != std::string::npos;
    if (escaped) ++at;
    part += text[at];
  }
  if (at == text.size())
    throw Error(ExitCode::usage,
                std::string("found a command line with an open ") + quote + ", expected another at its end");
  ++at;
  return part;
}

/// Reads the part of a word that begins at `at`: a quoted string, an escaped character or a plain one.
std::string word_part(const std::string& text, std::size_t& at) {
  const char c = text[at++];
  if (c == '\'' || c == '"') return quoted_part(text, at, c);
  if (c != '\\' || at == text.size()) return {c};
  const char escaped = text[at++];
  return escaped == '\n' ? std::string{} : std::string{escaped};
}

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n'; }

}  // namespace

std::vector<std::string> shell_words(const std::string& text) {
  std::vector<std::string> words;
  bool inside = false;
  for (std::size_t at = 0; at < text.size();) {
    if (is_blank(text[at])) {
      inside = false;
      ++at;
      continue;
    }
    if (!inside && text.compare(at, 2, "\\\n") == 0) {  // a line that goes on in the next one begins no word
      at += 2;
      continue;
    }
    if (!inside) words.emplace_back();
    inside = true;
    words.back() += word_part(text, at);
  }
  return words;
}

std::string shell_quoted(const std::string& word) {
  const auto plain = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
           std::string("_@%+=:,./-").find(c) != std::string::npos;
  };
  if (!word.empty() && std::all_of(word.begin(), word.end(), plain)) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string{c};
  return quoted + "'";
}

std::string command_line(const RenderOptions& options) {
  RenderOptions written;
  OptionList list("", PROGRAM);
  add_render_options(list, written);
  written = options;
  std::string line = PROGRAM;
  for (const std::string& word : list.changed_words()) line += " " + shell_quoted(word);
  return line;
}

RenderOptions parse_command_line(const std::string& text) {
  const std::vector<std::string> words = shell_words(text);
  if (words.empty() || std::filesystem::path(words[0]).filename() != PROGRAM)
    throw Error(ExitCode::usage, "found a command line of '" + (words.empty() ? "" : words[0]) +
                                     "', expected one of " + PROGRAM);
  return parse_render_words({words.begin() + 1, words.end()});
}

}  // namespace splatray
