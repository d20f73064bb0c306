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

void OptionList::add_value(const std::string& name, const Read& read, const Write& write,
                           const std::string& help, const std::string& value_name) {
  parser_->add_option_function<std::string>(name, read, help)->type_name(value_name);
  if (!write) return;
  add_words([name, write] {
    const std::string text = write();
    return text.empty() ? Words{} : Words{name + "=" + text};
  });
}

void OptionList::add_repeated(const std::string& name, const Read& read, const std::string& help,
                              const std::string& value_name) {
  parser_->add_option_function<std::string>(name, read, help)->trigger_on_parse()->type_name(value_name);
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
  add_words([name, &target] { return target ? Words{name} : Words{}; });
}

void OptionList::add_answer(const std::string& name, const Write& answer, const std::string& help) {
  parser_->add_flag_callback(
      name, [answer] { throw CLI::CallForVersion(answer(), 0); }, help);
}

void OptionList::add_words(std::function<Words()> words) {
  const Words initial = words();
  writers_.push_back({std::move(words), initial});
}

void OptionList::require(const std::string& name) { parser_->get_option(name)->required(); }

void OptionList::set_footer(const std::string& text) { parser_->footer(text); }

void OptionList::remove_help() { parser_->set_help_flag(); }

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

Words OptionList::changed_words() const {
  Words changed;
  for (const Writer& writer : writers_) {
    const Words words = writer.words();
    if (words != writer.initial) changed.insert(changed.end(), words.begin(), words.end());
  }
  return changed;
}

}  // namespace splatray
