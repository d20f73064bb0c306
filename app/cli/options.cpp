#include "app/cli/options.h"

#include <algorithm>

namespace splatray {
namespace {

/// An option of one name that a field has or had.
void add_option(OptionList& list, const Field& field, const std::string& name, GivenFields& given,
                const std::string& note) {
  const OptionList::Read read = [&field, &given, note](const std::string& text) {
    given.values.push_back({field.name, text});
    if (!note.empty()) given.notes.push_back(note);
  };
  if (field.value.empty())
    list.add_switch(name, read, field.help);
  else if (field.repeated)
    list.add_repeated(name, read, field.help, field.value);
  else
    list.add_value(name, read, field.help, field.value);
}

}  // namespace

void add_fields(OptionList& list, FieldDoors door, const std::string& inputs, GivenFields& given,
                const std::vector<FieldGroup>& groups, const std::vector<std::string>& names) {
  for (const Field& field : fields()) {
    const bool asked = groups.empty() ||
                       std::find(groups.begin(), groups.end(), field.group) != groups.end() ||
                       std::find(names.begin(), names.end(), field.name) != names.end();
    if (!asked || !field.in(door)) continue;
    list.set_group(group_title(field.group));
    const std::string dashed = "--" + field.name;
    const std::string name = field.letter.empty() ? dashed : field.letter + "," + dashed;
    const bool is_input = field.name == "inputs";
    add_option(list, field, is_input ? inputs : name, given, "");
    list.set_brief(is_input ? inputs : dashed, field.brief);
    list.set_extensions(is_input ? inputs : dashed, field.extensions);
    list.set_group("");
    for (const std::string& old : field.old_names)
      if (find_field(old, door) == &field)
        add_option(list, field, "--" + old, given, "--" + old + " is now " + dashed);
  }
}

void assign(Request& request, const GivenFields& given, FieldDoors door) {
  assign(request, given.values, door, {"--", " (--help lists the options)"});
}

}  // namespace splatray
