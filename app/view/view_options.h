/// The command line of splatray-view: fields as splatray-render has them.
#pragma once
#include <optional>

#include "app/library/request/request.h"

namespace splatray {

/// The request, or nothing when help, with the table of keys, or version was asked for and printed. It may name no file; its size is the
/// window's, screen coordinates, 0 x 0 = as it was last. Throws Error (usage), one sentence.
[[nodiscard]] std::optional<Request> parse_view_options(int argc, char** argv);

}  // namespace splatray
