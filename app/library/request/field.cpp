#include "app/library/request/field.h"

#include <array>

#include "engine/base/number_text.h"

namespace splatray {

const char* group_title(FieldGroup group) {
  constexpr std::array TITLES = {"Input", "Look",    "Light",  "Camera", "Region",
                                 "Sheet", "Quality", "Output", "Files",  "Research"};  // FieldGroup
  return TITLES[static_cast<std::size_t>(group)];
}

Field with(Field field, FieldExtras extras) {
  field.doors = extras.doors;
  field.why_not = std::move(extras.why_not);
  field.old_names = std::move(extras.old_names);
  field.letter = std::move(extras.letter);
  return field;
}

Field needed(Field field, std::string brief) {
  field.brief = std::move(brief);
  return field;
}

Field Field::marked(FieldTraits more) const {
  Field field = *this;
  field.traits |= more;
  return field;
}

Field Field::of_looks(std::initializer_list<std::uint32_t> users) const {
  Field field = *this;
  field.looks = 0;
  for (const std::uint32_t look : users) field.looks |= 1U << look;
  return field;
}

std::string text_of(double value) { return number_text(value); }
std::string text_of(float value) { return number_text(value); }
std::string text_of(std::uint64_t value) { return std::to_string(value); }

Field value_row(std::string name, FieldGroup group, std::string value, std::string help,
                std::function<void(Request&, const std::string&)> read,
                std::function<std::string(const Request&)> write) {
  Field row;
  row.group = group;
  row.value = std::move(value);
  row.help = std::move(help);
  row.read = std::move(read);
  if (write)
    row.write = [name, write = std::move(write)](const Request& request) {
      const std::string text = write(request);
      return text.empty() ? std::vector<FieldText>{} : std::vector<FieldText>{{name, text}};
    };
  row.name = std::move(name);
  return row;
}

}  // namespace splatray
