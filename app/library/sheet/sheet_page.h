/// The page around a sheet's picture.
#pragma once
#include <span>
#include <string>

#include "app/library/codec/drawing.h"
#include "app/library/display_image.h"
#include "app/library/measure/measure.h"
#include "app/library/shot/sheet.h"

namespace splatray {

/// Pixels as rasters have them: four bytes each, opaque where the picture has no alpha.
[[nodiscard]] std::vector<std::uint8_t> rgba_bytes(const DisplayImage& picture);

/// The picture of a window of the sheet at its scale, with coordinates at its border, a grid of crosses, a bar, the scale, north
/// where the paper has it, `title`, and what a reader must know: cut, depth, coordinate system, size of a pixel, what colours mean.
[[nodiscard]] Drawing sheet_page(const Sheet& sheet, const PixelWindow& window, const DisplayImage& picture,
                                 const std::string& title);

/// Draws measures on the page of a window of the sheet: their lines as the paper has them, and their values. `up` of the scene.
void draw_measures(const Sheet& sheet, const PixelWindow& window, std::span<const Measure> measures,
                   const glm::dvec3& up, Drawing& page);

}  // namespace splatray
