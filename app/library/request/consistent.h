/// What no single field can check of a request.
#pragma once
#include "app/library/request/request.h"

namespace splatray {

/// Throws Error (usage), one sentence, where fields exclude or need others, or a file's format cannot hold what is asked for; there
/// may be no inputs and no output.
void require_consistent(const Request& request);

/// Throws Error (usage), one sentence, where --crop or --tile are beyond a picture of this size.
void require_part_of(const Request::View& view, std::uint32_t width, std::uint32_t height);

}  // namespace splatray
