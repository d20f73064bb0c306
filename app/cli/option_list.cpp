#include "app/cli/option_list.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "engine/base/error.h"

namespace splatray {

struct OptionList::Parser : CLI::App {
  using CLI::App::App;
};

OptionList::OptionList(const std::string& description, const std::string& program)
    : parser_(std::make_unique<Parser>(description, program)) {
  parser_->option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
}

OptionList::~OptionList() = default;

void OptionList::set_group(const std::string& title) { parser_->option_defaults()->group(title); }

void OptionList::add_value(const std::string& name, const Read& read, const std::string& help,
                           const std::string& value_name) {
  parser_->add_option_function<std::string>(name, read, help)->type_name(value_name);
}

void OptionList::add_repeated(const std::string& name, const Read& read, const std::string& help,
                              const std::string& value_name) {
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
  const auto read = [&target](const Words& paths) { target.assign(paths.begin(), paths.end()); };
  CLI::Option* option = parser_->add_option_function<Words>(name, read, help);
  option->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)->type_name(value_name);
  if (name.starts_with('-')) option->allow_extra_args(false);
}

void OptionList::add_switch(const std::string& name, bool& target, const std::string& help) {
  parser_->add_flag(name, target, help);
}

void OptionList::add_switch(const std::string& name, const Read& read, const std::string& help) {
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
  parser_->add_flag_callback(
      name, [answer] { throw CLI::CallForVersion(answer(), 0); }, help);
}

void OptionList::require(const std::string& name) { parser_->get_option(name)->required(); }

void OptionList::set_footer(const std::string& text) { parser_->footer(text); }

bool OptionList::parse(int argc, char** argv) { return parse(Words(argv + std::min(argc, 1), argv + argc)); }

bool OptionList::parse(const Words& words) {
  try {
    parser_->parse(Words(words.rbegin(), words.rend()));
  } catch (const CLI::Success& success) {
    parser_->exit(success);
    return false;
  } catch (const CLI::ParseError& error) {
    std::string sentence = error.what();
    std::replace(sentence.begin(), sentence.end(), '\n', ' ');
    throw Error(ExitCode::usage, sentence + " (--help lists the options)");
  }
  return true;
}

}  // namespace splatray
