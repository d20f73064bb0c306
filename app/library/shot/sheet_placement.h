/// Where a sheet lies in its scene.
#pragma once
#include "app/library/request/request.h"
#include "app/library/shot/sheet.h"
#include "engine/scene/scene.h"

namespace splatray {

/// Refuses sheets that take long for what is on them: a few points far apart at a large scale. Throws Error (usage).
void require_sheet_pixels(double width, double height, std::size_t splats);

/// The sheet of what the request's region holds. The scene has its pools. Throws Error (usage), one sentence, for one that has
/// nothing on it, more pixels than a picture may have, or lengths in degrees.
[[nodiscard]] Sheet make_sheet(const Scene& scene, const Request& request);

}  // namespace splatray
