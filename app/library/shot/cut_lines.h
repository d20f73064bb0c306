/// What a sheet cuts: the lines in which its plane meets the splats' discs.
#pragma once
#include <vector>

#include "app/library/shot/sheet.h"
#include "engine/image/image.h"

namespace splatray {

/// A line of each disc that the plane `sheet.near` crosses and the region holds, but of those nearly in the plane. The scene has
/// its pools.
[[nodiscard]] std::vector<CutLine> cut_lines(const Scene& scene, const Region& region, const Sheet& sheet);

/// Draws them, black and as wide as the sheet asks for, over the window of its picture that the image is of. Linear colours.
void draw_cut(const Sheet& sheet, const PixelWindow& window, Image& image);

}  // namespace splatray
