/// Controls made of the table of fields; Dear ImGui inside a window begun.
#pragma once
#include <string>

#include "app/library/request/fields.h"
#include "app/view/ui/panels.h"

namespace splatray {

/// A control for one field of a request, by the field's kind, with the help's words as its tip; of a repeated field one for each value
/// and one more. Returns whether it changed the request; a value that is refused becomes a sentence in `error`.
bool field_control(const Field& field, Request& request, std::string& error);

/// All fields of what is seen, by the groups of the help, folded. A change is asked for as Requests::change.
void all_fields(const Document& document, PanelState& state, Requests& requests);

}  // namespace splatray
