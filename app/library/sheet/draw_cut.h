/// The lines of what a sheet cuts, in its picture.
#pragma once
#include "app/library/shot/sheet.h"
#include "engine/image/image.h"

namespace splatray {

/// Draws them, black and as wide as the sheet asks for, over the window of its picture that the image is of. Linear colours.
void draw_cut(const Sheet& sheet, const PixelWindow& window, Image& image);

}  // namespace splatray
