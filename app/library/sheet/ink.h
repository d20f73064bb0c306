/// Lines of a sheet where its surfaces end or turn.
#pragma once
#include "app/library/sheet/sheet.h"
#include "engine/image/image.h"

namespace splatray {

/// Draws black lines where the image's AOVs change: depth by more than the surface's own slope gives, direction, object (Saito,
/// Takahashi 1990, "Comprehensible Rendering of 3-D Shapes"). The image has AOVs. Linear colours.
void draw_ink(const Sheet& sheet, Image& image);

}  // namespace splatray
