/// The page of a sheet: a paper's frame, the drawing, and what stands below it.
#pragma once
#include <span>
#include <string>
#include <vector>

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

/// The pages of several sheets, their rasters yet without pixels: of an atlas a page for each floor, all on one paper and the drawing at one
/// place of it, numbered 1/n, with the measures of the floor's storey; of views one page, which has
/// them in rows with their captions. Throws Error as sheet_page does.
[[nodiscard]] std::vector<Drawing> sheet_pages(const SheetSet& set, const PageWords& words,
                                               std::span<const Measure> measures);

/// The measures that one of several sheets shows, empty ones in place of the others. An atlas' floor has those whose points' mean height is
/// not below it and below the next floor, the lowest all below, too; a view those whose lines are the longest on it, of several the first.
[[nodiscard]] std::vector<Measure> measures_of_sheet(const SheetSet& set, std::size_t index,
                                                     std::span<const Measure> measures);
/// "Floor at height 3.10 m", or from level= on "Floor at +3.10".
[[nodiscard]] std::string floor_text(const Sheet& sheet);

/// Gives the page the picture of its window, the first one or another.
void set_picture(const DisplayImage& picture, Drawing& page, std::size_t index = 0);

}  // namespace splatray
