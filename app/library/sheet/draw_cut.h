/// The lines of a sheet in its picture: of what it cuts, with its hatching, of what is seen, and contours.
#pragma once
#include <vector>

#include "app/library/shot/sheet.h"
#include "engine/image/image.h"

namespace splatray {

/// Draws them, black and as wide as on a page, over the window of its picture that the image is of. Linear colours.
void draw_cut(const Sheet& sheet, const PixelWindow& window, Image& image);

/// How much of each pixel of the window, 0 to 1, lies so near to a line of what is cut that discs which cross the plane overhang it.
[[nodiscard]] std::vector<float> beside_cut(const Sheet& sheet, const PixelWindow& window);

/// Takes out of the image what is seen in what is cut: discs that lie in walls.
void clear_solids(const Sheet& sheet, const PixelWindow& window, Image& image);

}  // namespace splatray
