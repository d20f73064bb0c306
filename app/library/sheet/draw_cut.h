/// The lines of a sheet in its picture: of what it cuts, with its hatching, and contours.
#pragma once
#include "app/library/shot/sheet.h"
#include "engine/image/image.h"

namespace splatray {

/// Draws them, black and as wide as on a page, over the window of its picture that the image is of. Linear colours.
void draw_cut(const Sheet& sheet, const PixelWindow& window, Image& image);

}  // namespace splatray
