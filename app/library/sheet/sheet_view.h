/// The drawing itself on its page: the picture at its scale, coordinates at its border, a grid of crosses, what is cut.
#pragma once
#include <string>

#include "app/library/codec/drawing.h"
#include "app/library/shot/sheet.h"
#include "engine/image/view.h"

namespace splatray {

enum class Rounding { down, up };
/// The next of 1, 2, 5 times a power of ten. `length` > 0.
[[nodiscard]] double round_length(double length, Rounding way);

/// A length in the file's units, such as "1.2 m".
[[nodiscard]] std::string length_text(const Sheet& sheet, double world);

/// A window of the sheet as a part of a page, with room around for its coordinates; its raster has a corner and a size, but no pixels.
[[nodiscard]] Drawing sheet_view(const Sheet& sheet, const PixelWindow& window);

/// A place of the paper, world units along Sheet::right and top, in millimetres from the top left corner of the window.
[[nodiscard]] glm::dvec2 in_window(const Sheet& sheet, const PixelWindow& window, const glm::dvec2& place);

}  // namespace splatray
