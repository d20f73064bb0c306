#include "app/cli/option_list.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <stdexcept>
#include <utility>

#include "app/cli/completion.h"
#include "engine/base/error.h"
#include "engine/base/nearest_name.h"

namespace splatray {

struct OptionList::Parser : CLI::App {
  using CLI::App::App;
};

OptionList::OptionList(const std::string& description, const std::string& program)
    : parser_(std::make_unique<Parser>(description, program)), page_{program, description} {
  parser_->option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  parser_->set_help_flag();
  add_answer(
      "-h", [this] { return short_help(page_); }, "the options that most people need");
  add_answer(
      "--help", [this] { return long_help(page_, help_width()); }, "all options, and examples");
  add_answer(
      "--version", [] { return SPLATRAY_VERSION; }, "the version");
  set_group("");
  const Read complete = [this](const std::string& shell) {
    throw CLI::CallForVersion(completion_script(page_, shell), 0);
  };
  add_value("--completion", complete, "a script that completes command lines", "bash|zsh|fish");
  parser_->get_option("--completion")->trigger_on_parse();
  set_group("Options");
}

OptionList::~OptionList() = default;

void OptionList::set_group(const std::string& title) { group_ = title; }

OptionEntry& OptionList::entry(const std::string& name) {
  const auto found =
      std::find_if(page_.entries.begin(), page_.entries.end(), [&name](const OptionEntry& one) {
        const std::vector<std::string> names = one.names();
        return std::find(names.begin(), names.end(), name) != names.end();
      });
  if (found == page_.entries.end()) throw std::logic_error("no option " + name);
  return *found;
}

void OptionList::add_value(const std::string& name, const Read& read, const std::string& help,
                           const std::string& value_name) {
  parser_->add_option_function<std::string>(name, read, help)->type_name(value_name);
  page_.entries.push_back({name, value_name, help, group_});
}

void OptionList::add_repeated(const std::string& name, const Read& read, const std::string& help,
                              const std::string& value_name) {
  page_.entries.push_back(
      {.name = name, .value = value_name, .help = help, .group = group_, .repeated = true});
  if (name.starts_with('-'))
    return void(parser_->add_option_function<std::string>(name, read, help)
                    ->trigger_on_parse()
                    ->type_name(value_name));
  const auto read_all = [read](const Words& words) { std::for_each(words.begin(), words.end(), read); };
  parser_->add_option_function<Words>(name, read_all, help)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->type_name(value_name);
}

void OptionList::add_paths(const std::string& name, std::vector<std::filesystem::path>& target,
                           const std::string& help, const std::string& value_name) {
  page_.entries.push_back(
      {.name = name, .value = value_name, .help = help, .group = group_, .repeated = true});
  const auto read = [&target](const Words& paths) { target.assign(paths.begin(), paths.end()); };
  CLI::Option* option = parser_->add_option_function<Words>(name, read, help);
  option->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)->type_name(value_name);
  if (name.starts_with('-')) option->allow_extra_args(false);
}

void OptionList::add_switch(const std::string& name, bool& target, const std::string& help) {
  parser_->add_flag(name, target, help);
  page_.entries.push_back({name, "", help, group_});
}

void OptionList::add_switch(const std::string& name, const Read& read, const std::string& help) {
  page_.entries.push_back({name, "", help, group_});
  const auto read_word = [read](const std::string& word) {
    read(word == "true" ? "on" : word == "false" ? "off" : word);
  };
  parser_
      ->add_flag_function(
          name, [](std::int64_t) {}, help)
      ->each(read_word);
}

void OptionList::add_answer(const std::string& name, const std::function<std::string()>& answer,
                            const std::string& help) {
  parser_
      ->add_flag_callback(
          name, [answer] { throw CLI::CallForVersion(answer(), 0); }, help)
      ->trigger_on_parse();
  page_.entries.push_back({name, "", help, group_});
}

void OptionList::require(const std::string& name) {
  parser_->get_option(name)->required();
  entry(name).required = true;
}

void OptionList::set_brief(const std::string& name, const std::string& brief) { entry(name).brief = brief; }

void OptionList::set_extensions(const std::string& name, const std::string& extensions) {
  entry(name).extensions = extensions;
}

void OptionList::set_examples(std::vector<HelpExample> examples) { page_.examples = std::move(examples); }

void OptionList::add_table(HelpTable table) { page_.tables.push_back(std::move(table)); }

std::string OptionList::unknown_word() const {
  Words names;
  for (const OptionEntry& known : page_.entries)
    if (known.is_named() && !known.group.empty())
      for (const std::string& name : known.names())
        names.push_back(name.substr(name.rfind("--") == 0 ? 2 : 1));
  for (const std::string& word : parser_->remaining()) {
    if (word == "--") continue;
    if (!word.starts_with('-')) return "found '" + word + "', expected no further word";
    const std::string name = word.substr(0, word.find('='));
    return "unknown option " + name + did_you_mean(name.substr(name.find_first_not_of('-')), names, "--");
  }
  return {};
}

std::string OptionList::missing_word() const {
  for (const OptionEntry& known : page_.entries) {
    const std::string name = known.names().back();
    if (!known.required || parser_->get_option(name)->count() > 0) continue;
    return "found no " + name + ", expected " +
           (known.is_named() ? known.names().front() + " " + known.value : "at least one");
  }
  return {};
}

bool OptionList::parse(int argc, char** argv) { return parse(Words(argv + std::min(argc, 1), argv + argc)); }

Words OptionList::with_empty_values(const Words& words) const {
  const auto takes_value = [this](const std::string& name) {
    return std::any_of(page_.entries.begin(), page_.entries.end(), [&name](const OptionEntry& one) {
      const Words names = one.names();
      return !one.value.empty() && std::find(names.begin(), names.end(), name) != names.end();
    });
  };
  Words all;
  bool are_options = true;
  for (const std::string& word : words) {
    are_options = are_options && word != "--";
    const std::string name = word.substr(0, word.find('='));
    const bool is_empty = are_options && word == name + '=' && name.starts_with("--") && takes_value(name);
    all.push_back(is_empty ? name : word);
    if (is_empty) all.emplace_back();
  }
  return all;
}

bool OptionList::parse(const Words& words) {
  try {
    const Words all = with_empty_values(words);
    parser_->parse(Words(all.rbegin(), all.rend()));
  } catch (const CLI::Success& success) {
    parser_->exit(success);
    return false;
  } catch (const CLI::ParseError& error) {
    std::string sentence = unknown_word();
    if (sentence.ends_with('?')) throw Error(ExitCode::usage, sentence);
    if (sentence.empty() && error.get_exit_code() == int(CLI::ExitCodes::RequiredError))
      sentence = missing_word();
    if (sentence.empty()) sentence = error.what();
    std::replace(sentence.begin(), sentence.end(), '\n', ' ');
    throw Error(ExitCode::usage, sentence + " (--help lists the options)");
  }
  return true;
}

}  // namespace splatray
