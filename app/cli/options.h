/// The command lines of programs that make pictures: what each option means stands in the table of fields (app/library/request).
#pragma once
#include <string>
#include <vector>

#include "app/cli/option_list.h"
#include "app/library/request/fields.h"

namespace splatray {

/// What a command line says of fields, and sentences about its old names.
struct GivenFields {
  std::vector<FieldText> values;
  std::vector<std::string> notes;
};

/// Adds the fields that `door` has to a program's options, each in the group of its help; `inputs` under that name and without one.
/// Parsing fills `given`, which must outlive the list. `groups`: only fields of these, and those of `names`; empty = all.
void add_fields(OptionList& list, FieldDoors door, const std::string& inputs, GivenFields& given,
                const std::vector<FieldGroup>& groups = {}, const std::vector<std::string>& names = {});

/// Reads what was given into the request. Throws Error (usage), one sentence.
void assign(Request& request, const GivenFields& given, FieldDoors door);

}  // namespace splatray
