/// Lines of a sheet where its surfaces end or turn.
#pragma once
#include <span>

#include "app/library/shot/sheet.h"
#include "engine/image/image.h"

namespace splatray {

/// What the rays through the centres of some of a sheet's pixels hit, top row first.
struct SeenPixels {
  PixelWindow window;
  std::span<const AovPixel> aov;
};

/// What must be seen to draw the lines of a part of the sheet: its pixels and as many around it as lines are wide.
[[nodiscard]] PixelWindow ink_window(const Sheet& sheet, const PixelWindow& part);

/// Draws black lines where what is seen changes: depth by more than the surface's own slope gives, direction, object (Saito,
/// Takahashi 1990, "Comprehensible Rendering of 3-D Shapes"), but beside what is cut (beside_cut). The image is of the part; linear colours.
void draw_ink(const Sheet& sheet, const SeenPixels& seen, const PixelWindow& part, Image& image);

}  // namespace splatray
