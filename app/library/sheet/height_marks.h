/// Heights on a drawing: contour lines with their heights, and level marks.
#pragma once
#include <string>

#include "app/library/codec/drawing.h"
#include "app/library/shot/sheet.h"
#include "engine/image/view.h"

namespace splatray {

/// Width of a contour's line on paper, millimetres: every fifth is wider.
[[nodiscard]] double contour_width_mm(const Sheet& sheet, const Contour& contour);
/// The height of a contour, with as many digits as the interval has.
[[nodiscard]] std::string contour_text(const Sheet& sheet, const Contour& contour);
/// A height above the level that is +0.00, as "+2.80"; of millimetres without decimals.
[[nodiscard]] std::string level_text(const Sheet& sheet, double height);
/// A height with its unit, with the digits of level marks, "3.10 m".
[[nodiscard]] std::string height_text(const Sheet& sheet, double height);
/// Whether a sheet shows heights along its top, so that levels are lines on it: sections and elevations.
[[nodiscard]] bool is_upright_sheet(const Sheet& sheet);

/// Draws the contours on a view (sheet_view.h); where there is room, one of each height says it.
void draw_contours(const Sheet& sheet, const PixelWindow& window, Drawing& view);
/// Draws the levels of an upright sheet with their heights to the right of its view, which grows. Where two have no room for their marks
/// one above the other, the upper one's mark stands higher, at the end of a bent line.
void draw_levels(const Sheet& sheet, const PixelWindow& window, Drawing& view);

}  // namespace splatray
