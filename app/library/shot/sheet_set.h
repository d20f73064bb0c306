/// The sheets of a request for several.
#pragma once
#include "app/library/request/request.h"
#include "app/library/shot/sheet.h"
#include "engine/scene/scene.h"

namespace splatray {

/// The views of a page, or of an atlas the plans of all floors (storey_floors), which show the same rectangle of the ground. The scene has
/// its pools. Throws Error (usage), one sentence, as make_sheet does, and for an atlas of what has no floor.
[[nodiscard]] SheetSet make_sheet_set(const Scene& scene, const Request& request);

}  // namespace splatray
