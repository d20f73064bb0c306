/// Loading of scenes by programs, as they report it.
#pragma once
#include "app/library/shot/scene_source.h"
#include "engine/base/progress.h"

namespace splatray {

/// load_scene, its progress on the line, which is cleared in the end, and what is odd about the files as notes of the program on
/// stderr, unless the request is quiet. A signal ends it. Throws Error.
[[nodiscard]] LoadedScene load_reporting(const Request& request, const char* program, ProgressLine& line);

}  // namespace splatray
