/// The table of all that can be asked for. Help, man pages, completion of shells, the viewer's panels, C++, Python, JSON and what a picture keeps of
/// its command come from it.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "app/library/request/field.h"

namespace splatray {

/// All fields, in the order of the help and of reading: those after `camera` change parts of its camera.
[[nodiscard]] std::span<const Field> fields();

/// The field of this name, or of this old name where no field of `door` has that as its name; null where there is none in the
/// door.
[[nodiscard]] const Field* find_field(const std::string& name, FieldDoors door);

/// The names of the fields that a door has.
[[nodiscard]] std::vector<std::string> names_of(FieldDoors door);

/// How a door spells the name of a field, and what its sentences end with.
struct FieldSpelling {
  std::string before{}, after{};
};

/// Reads values into the request, whatever their order: in the order of the table, those of a family in theirs; of a field that
/// is not repeated the last holds. Throws Error (usage), one sentence, for a name that the door does not have and for a value
/// that is none.
void assign(Request& request, const std::vector<FieldText>& values, FieldDoors door,
            const FieldSpelling& spelling = {});

/// Reads one value into the request, as assign() does, beside what the field's family has. Throws Error (usage), one sentence.
void read_value(const Field& field, const std::string& text, Request& request,
                const FieldSpelling& spelling = {});

/// All values of the field's family in the request, in their order.
[[nodiscard]] std::vector<FieldText> family_values(const Field& field, const Request& request);
/// The texts of the field itself.
[[nodiscard]] std::vector<std::string> texts_of(const Field& field, const Request& request);

/// The values of fields that differ from Request{}'s, in the order of the table. assign() makes an equal request of them.
[[nodiscard]] std::vector<FieldText> changed_values(const Request& request);

// The rows of each group, and of several.
[[nodiscard]] std::vector<Field> input_fields();
[[nodiscard]] std::vector<Field> look_fields();
[[nodiscard]] std::vector<Field> light_fields();
[[nodiscard]] std::vector<Field> camera_fields();
[[nodiscard]] std::vector<Field> region_fields();
[[nodiscard]] std::vector<Field> sheet_fields();
[[nodiscard]] std::vector<Field> quality_fields();
[[nodiscard]] std::vector<Field> output_fields();
[[nodiscard]] std::vector<Field> research_fields();

}  // namespace splatray
