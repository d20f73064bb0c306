#include "app/library/request/command_line.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "app/library/request/consistent.h"
#include "app/library/request/fields.h"
#include "engine/base/error.h"
#include "engine/base/nearest_name.h"

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

using Words = std::vector<std::string>;

/// The word of a value: of inputs the file alone, of switches the name.
std::string word_of(const FieldText& value) {
  if (value.name == "inputs") return value.text.starts_with('-') ? "./" + value.text : value.text;
  const Field& field = *find_field(value.name, DOOR_RENDER);
  if (field.value.empty() && value.text == "on") return "--" + value.name;
  return "--" + value.name + "=" + value.text;
}

/// The field of an option's name, with its dashes.
const Field& option_field(const std::string& name) {
  if (name.starts_with("--"))
    if (const Field* field = find_field(name.substr(2), DOOR_RENDER)) return *field;
  for (const Field& field : fields())
    if (field.letter == name) return field;
  const std::string word = name.substr(std::min(name.find_first_not_of('-'), name.size()));
  throw Error(ExitCode::usage, "found '" + name + "', expected an option of " + PROGRAM +
                                   did_you_mean(word, names_of(DOOR_RENDER), "--"));
}

/// The value of an option at `at`, which it skips: behind an equals sign, in the next word, or that of a switch.
FieldText option_value(const Words& words, std::size_t& at) {
  const std::string& word = words[at++];
  const std::size_t equals = word.starts_with("--") ? word.find('=') : std::string::npos;
  const Field& field = option_field(word.substr(0, equals));
  if (equals != std::string::npos) return {field.name, word.substr(equals + 1)};
  if (field.value.empty()) return {field.name, "on"};
  if (at == words.size()) throw Error(ExitCode::usage, "found '" + word + "', expected a value behind it");
  return {field.name, words[at++]};
}

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

std::string command_line(const Request& request) {
  std::string line = PROGRAM;
  for (const FieldText& value : changed_values(request))
    line += value.name == "output" ? " -o " + shell_quoted(value.text) : " " + shell_quoted(word_of(value));
  return line;
}

Request parse_command_line(const std::string& text) {
  const Words words = shell_words(text);
  if (words.empty() || std::filesystem::path(words[0]).filename() != PROGRAM)
    throw Error(ExitCode::usage, "found a command line of '" + (words.empty() ? "" : words[0]) +
                                     "', expected one of " + PROGRAM);
  std::vector<FieldText> values;
  for (std::size_t at = 1; at < words.size();) {
    if (words[at].size() > 1 && words[at].starts_with('-'))
      values.push_back(option_value(words, at));
    else
      values.push_back({"inputs", words[at++]});
  }
  Request request;
  assign(request, values, DOOR_RENDER, {"--", ""});
  require_consistent(request);
  return request;
}

}  // namespace splatray
