/// The files of a run of a program, none of which is input and output (engine/file/file_roles.h).
#pragma once
#include "app/library/shot/sequence.h"

namespace splatray {

/// Notes the files that a request names. Throws Error (usage) as note_input does.
void note_inputs(const Request& request);

/// Throws Error (input_unreadable) for the first of the files that the request reads which is not there: programs ask before they open
/// a device. What lies on a server is not asked for.
void require_inputs_present(const Request& request);

/// Claims all that a run of splatray-render may write: pictures, what lies beside them, and files of their own. Throws Error
/// (usage) as claim_output and require_film_maker do.
void claim_outputs(const Request& request, const std::vector<SequenceFrame>& frames);

/// The same for processes that make pictures as often as they like: throws Error (usage) where one of these files is an input.
void require_no_inputs_replaced(const Request& request, const std::vector<SequenceFrame>& frames);

}  // namespace splatray
