#include "app/library/request/fields.h"

#include <algorithm>
#include <set>

#include "engine/base/error.h"
#include "engine/base/nearest_name.h"

namespace splatray {
namespace {

std::vector<Field> all_fields() {
  std::vector<Field> all;
  for (std::vector<Field> (*group)() : {input_fields, look_fields, light_fields, camera_fields, region_fields,
                                        sheet_fields, quality_fields, output_fields, research_fields})
    for (Field& field : group()) all.push_back(std::move(field));
  return all;
}

/// A value and its field; rank: where the family begins in the table.
struct Assignment {
  const Field* field;
  const std::string* text;
  std::size_t rank;
};

std::size_t rank_of(const Field& field) {
  const auto all = fields();
  const auto found = std::find_if(
      all.begin(), all.end(), [&](const Field& other) { return other.family_name() == field.family_name(); });
  return static_cast<std::size_t>(found - all.begin());
}

/// Whether a later one of the same field takes the place of this one.
bool is_overruled(const std::vector<Assignment>& values, std::size_t at) {
  if (values[at].field->repeated) return false;
  return std::any_of(values.begin() + static_cast<std::ptrdiff_t>(at) + 1, values.end(),
                     [&](const Assignment& later) { return later.field == values[at].field; });
}

}  // namespace

std::span<const Field> fields() {
  static const std::vector<Field> ALL = all_fields();
  return ALL;
}

const Field* find_field(const std::string& name, FieldDoors door) {
  const Field* old = nullptr;
  for (const Field& field : fields()) {
    if (!field.in(door)) continue;
    if (field.name == name) return &field;
    if (std::count(field.old_names.begin(), field.old_names.end(), name) > 0) old = &field;
  }
  return old;
}

std::vector<std::string> names_of(FieldDoors door) {
  std::vector<std::string> names;
  for (const Field& field : fields())
    if (field.in(door)) names.push_back(field.name);
  return names;
}

void read_value(const Field& field, const std::string& text, Request& request,
                const FieldSpelling& spelling) {
  try {
    field.read(request, text);
  } catch (const Expected& expected) {
    throw Error(ExitCode::usage, spelling.before + field.name + ": found '" + text + "', expected " +
                                     expected.what + spelling.after);
  }
}

std::vector<FieldText> family_values(const Field& field, const Request& request) {
  std::vector<FieldText> values;
  for (const Field& member : fields())
    if (member.family_name() == field.family_name() && member.write)
      for (const FieldText& value : member.write(request)) values.push_back(value);
  return values;
}

std::vector<std::string> texts_of(const Field& field, const Request& request) {
  std::vector<std::string> texts;
  for (const FieldText& value : family_values(field, request))
    if (value.name == field.name) texts.push_back(value.text);
  return texts;
}

void assign(Request& request, const std::vector<FieldText>& values, FieldDoors door,
            const FieldSpelling& spelling) {
  std::vector<Assignment> sorted;
  for (const FieldText& value : values) {
    const Field* field = find_field(value.name, door);
    if (field == nullptr)
      throw Error(ExitCode::usage,
                  "found '" + spelling.before + value.name + "', expected the name of a field" +
                      did_you_mean(value.name, names_of(door), spelling.before) + spelling.after);
    sorted.push_back({field, &value.text, rank_of(*field)});
  }
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const Assignment& a, const Assignment& b) { return a.rank < b.rank; });
  std::set<std::size_t> begun;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    if (is_overruled(sorted, i)) continue;
    const Field& field = *sorted[i].field;
    if (field.repeated && begun.insert(sorted[i].rank).second && !field.adds) field.clear(request);
    read_value(field, *sorted[i].text, request, spelling);
  }
}

std::vector<FieldText> changed_values(const Request& request) {
  static const Request UNCHANGED;
  std::vector<FieldText> changed;
  for (const Field& field : fields()) {
    if (!field.write) continue;
    const std::vector<FieldText> values = field.write(request);
    if (values != field.write(UNCHANGED)) changed.insert(changed.end(), values.begin(), values.end());
  }
  return changed;
}

}  // namespace splatray
