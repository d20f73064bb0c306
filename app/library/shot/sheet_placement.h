/// Where a sheet lies in its scene.
#pragma once
#include "app/library/request/request.h"
#include "app/library/shot/sheet.h"
#include "engine/scene/scene.h"

namespace splatray {

/// Length of a world unit of a sheet in this system: as asked for, as the system says, or a metre. Throws Error (usage) for degrees.
[[nodiscard]] double sheet_unit_metres(const SheetRequest& asked, const std::string& crs);

/// Refuses sheets that take long for what is on them: a few points far apart at a large scale. Throws Error (usage).
void require_sheet_pixels(double width, double height, std::size_t splats);

/// The sheet of what the request's region holds. The scene has its pools. Throws Error (usage), one sentence, for one that has
/// nothing on it, more pixels than a picture may have, or lengths in degrees.
[[nodiscard]] Sheet make_sheet(const Scene& scene, const Request& request);

}  // namespace splatray
