#include "app/cli/option_types.h"

#include "engine/base/error.h"

namespace splatray {

void refuse_option(const std::string& option, const std::string& value, const std::string& expected) {
  throw Error(ExitCode::usage,
              option + ": found '" + value + "', expected " + expected + " (--help lists the options)");
}

void add_text(OptionList& list, const std::string& name, std::string& target, const std::string& help,
              const std::string& value_name) {
  list.add_value(
      name, [&target](const std::string& text) { target = text; }, help, value_name);
}

void add_path(OptionList& list, const std::string& name, std::filesystem::path& target,
              const std::string& help, const std::string& value_name) {
  list.add_value(
      name, [&target](const std::string& text) { target = text; }, help, value_name);
}

}  // namespace splatray
