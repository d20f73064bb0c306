#include "app/cli/option_list.h"

namespace splatray {

OptionList::OptionList(const std::string& description, const std::string& program)
    : CLI::App(description, program) {
  option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
}

void OptionList::add_words(std::function<Words()> words) {
  const Words initial = words();
  writers_.push_back({std::move(words), initial});
}

CLI::Option* OptionList::add_value(const std::string& name, std::function<void(const std::string&)> read,
                                   std::function<std::string()> write, const std::string& help) {
  add_words([name, write] {
    const std::string text = write();
    return text.empty() ? Words{} : Words{name + "=" + text};
  });
  return add_option_function<std::string>(name, read, help);
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
