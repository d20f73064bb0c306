/// The page of a sheet: a paper's frame, the drawing, and what stands below it.
#pragma once
#include <span>
#include <string>

#include "app/library/codec/drawing.h"
#include "app/library/display_image.h"
#include "app/library/measure/measure.h"
#include "app/library/sheet/page_blocks.h"
#include "app/library/shot/sheet.h"

namespace splatray {

/// Pixels as rasters have them: four bytes each, opaque where the picture has no alpha.
[[nodiscard]] std::vector<std::uint8_t> rgba_bytes(const DisplayImage& picture);

/// The page of a window of the sheet, its raster yet without pixels: a frame (ISO 5457) on the paper that is asked for, else on the
/// smallest of A4 to A0 that holds all, else on one made to measure; in it the view (sheet_view.h) with the measures, below it the key
/// and, in the corner, the title block (page_blocks.h). No text covers another or leaves the frame. Throws Error (usage) where the
/// paper that is asked for is too small.
[[nodiscard]] Drawing sheet_page(const Sheet& sheet, const PixelWindow& window, const PageWords& words,
                                 std::span<const Measure> measures);

/// Gives the page the picture of its window.
void set_picture(const DisplayImage& picture, Drawing& page);

}  // namespace splatray
