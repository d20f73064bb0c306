#include "app/cli/completion.h"

#include <algorithm>
#include <sstream>

#include "engine/base/error.h"

namespace splatray {
namespace {

/// The entries that the help shows.
std::vector<OptionEntry> shown(const HelpPage& page, bool named) {
  std::vector<OptionEntry> entries;
  std::copy_if(
      page.entries.begin(), page.entries.end(), std::back_inserter(entries),
      [named](const OptionEntry& entry) { return !entry.group.empty() && entry.is_named() == named; });
  return entries;
}

std::string joined(const std::vector<std::string>& words, const std::string& between) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

/// What an option is, in the few words that a shell has room for: up to the first end of a thought.
std::string in_few_words(const OptionEntry& entry) {
  constexpr std::size_t MOST = 60;
  const std::string text = entry.brief.empty() ? entry.help : entry.brief;
  const std::string part = text.substr(0, text.find_first_of(";("));
  return part.size() <= MOST ? part.substr(0, part.find_last_not_of(' ') + 1)
                             : part.substr(0, part.rfind(' ', MOST)) + " ...";
}

/// Extensions as shells match them: ".las .laz" as las|laz, with `between` for the bar.
std::string patterns(const std::string& extensions, const std::string& between) {
  std::istringstream stream(extensions);
  std::vector<std::string> names;
  for (std::string extension; stream >> extension;) names.push_back(extension.substr(1));
  return joined(names, between);
}

/// The name of the function that a script for bash defines.
std::string bash_function(const HelpPage& page) {
  std::string name = "_" + page.program;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

/// A line that has bash offer the words that compgen finds.
std::string bash_offer(const std::string& words) {
  return "mapfile -t COMPREPLY < <(compgen " + words + " -- \"$word\")";
}

std::string bash_files(const OptionEntry& entry, const std::string& function) {
  if (entry.is_folder()) return bash_offer("-d");
  const std::string known = patterns(entry.extensions, "|");
  return known.empty() ? bash_offer("-f") : function + "_files '" + known + "'";
}

/// What completes a value in bash: nothing where nothing is known of it.
std::string bash_value(const OptionEntry& entry, const std::string& function) {
  if (entry.is_file() || entry.is_folder()) return bash_files(entry, function);
  const std::vector<std::string> choices = entry.choices();
  return choices.empty() ? ":" : bash_offer("-W '" + joined(choices, " ") + "'");
}

constexpr const char* BASH_FILES = R"(_files() {  # those with these extensions, and folders
  local file
  while IFS= read -r file; do
    if [[ -d $file || ${file,,} == *.@($1) ]]; then COMPREPLY+=("$file"); fi
  done < <(compgen -f -- "$word")
}
)";

/// bash breaks words at equals signs.
constexpr const char* BASH_BEGIN = R"(() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]}
  COMPREPLY=()
  if [[ $word == = ]]; then word=; elif [[ $before == = ]]; then before=${COMP_WORDS[COMP_CWORD-2]}; fi
  case $before in
)";

std::string bash_script(const HelpPage& page) {
  const std::string function = bash_function(page);
  std::string names, cases;
  for (const OptionEntry& entry : shown(page, true)) {
    names += (names.empty() ? "" : " ") + joined(entry.names(), " ");
    if (!entry.value.empty())
      cases += "    " + joined(entry.names(), "|") + ") " + bash_value(entry, function) + "; return ;;\n";
  }
  const std::vector<OptionEntry> unnamed = shown(page, false);
  const std::string rest = unnamed.empty() ? ":" : bash_value(unnamed.front(), function);
  return "# Completes the command lines of " + page.program + " in bash.\n" + function + BASH_FILES +
         function + BASH_BEGIN + cases + "  esac\n  if [[ $word == -* ]]; then " +
         bash_offer("-W '" + names + "'") + "; else " + rest + "; fi\n}\ncomplete -o filenames -F " +
         function + " " + page.program + "\n";
}

/// The text without what _arguments reads as its own, in single quotes.
std::string zsh_quoted(const std::string& text) {
  std::string quoted;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') quoted += '\\';
    quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  }
  return quoted;
}

std::string zsh_value(const OptionEntry& entry) {
  if (entry.is_folder()) return ":folder:_files -/";
  if (entry.is_file())
    return ":file:_files" +
           (entry.extensions.empty() ? "" : " -g \"*.(#i)(" + patterns(entry.extensions, "|") + ")\"");
  const std::vector<std::string> choices = entry.choices();
  return ":" + zsh_quoted(entry.value) + ":" + (choices.empty() ? "" : "(" + joined(choices, " ") + ")");
}

std::string zsh_script(const HelpPage& page) {
  std::string text = "#compdef " + page.program + "\n_arguments -s -S";
  for (const OptionEntry& entry : shown(page, true))
    for (const std::string& name : entry.names()) {
      const bool is_long = name.starts_with("--");
      text += " \\\n  '" + std::string(entry.repeated ? "*" : "") + name +
              (entry.value.empty() ? ""
               : is_long           ? "="
                                   : "+") +
              "[" + zsh_quoted(in_few_words(entry)) + "]" + (entry.value.empty() ? "" : zsh_value(entry)) +
              "'";
    }
  for (const OptionEntry& entry : shown(page, false))
    text += " \\\n  '" + std::string(entry.repeated ? "*" : "") +
            (entry.is_file() ? zsh_value(entry) : ":" + entry.name + ":") + "'";
  return text + "\n";
}

std::string fish_quoted(const std::string& text) {
  std::string quoted;
  for (const char c : text) quoted += (c == '\'' || c == '\\' ? "\\" : "") + std::string(1, c);
  return "'" + quoted + "'";
}

std::string fish_files(const OptionEntry& entry) {
  if (entry.is_folder()) return " -x -a '(__fish_complete_directories)'";
  if (entry.extensions.empty()) return " -r -F";
  return " -x -k -a '(__fish_complete_suffix " + entry.extensions + ")'";
}

std::string fish_value(const OptionEntry& entry) {
  if (entry.is_file() || entry.is_folder()) return fish_files(entry);
  const std::vector<std::string> choices = entry.choices();
  return choices.empty() ? " -x" : " -x -a '" + joined(choices, " ") + "'";
}

std::string fish_script(const HelpPage& page) {
  std::string text =
      "# Completes " + page.program + "'s command lines in fish.\ncomplete -c " + page.program + " -f\n";
  for (const OptionEntry& entry : shown(page, true)) {
    text += "complete -c " + page.program;
    for (const std::string& name : entry.names())
      text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
    text += (entry.value.empty() ? "" : fish_value(entry)) + " -d " + fish_quoted(in_few_words(entry)) + "\n";
  }
  for (const OptionEntry& entry : shown(page, false))
    if (entry.is_file()) text += "complete -c " + page.program + fish_files(entry) + "\n";
  return text;
}

}  // namespace

std::string completion_script(const HelpPage& page, const std::string& shell) {
  if (shell == "bash") return bash_script(page);
  if (shell == "zsh") return zsh_script(page);
  if (shell == "fish") return fish_script(page);
  throw Error(ExitCode::usage, "--completion: found '" + shell + "', expected bash, zsh or fish");
}

}  // namespace splatray
