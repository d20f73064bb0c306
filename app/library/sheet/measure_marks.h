/// Measures on a drawing: their points, lines and values.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "app/library/codec/drawing.h"
#include "app/library/measure/measure.h"
#include "app/library/shot/sheet.h"

namespace splatray {

/// Draws the measures whose points all lie in the window on its view (sheet_view.h): lines as the paper has them, values where they
/// cover no other text. Returns sentences for the page: the unit, and the values that found no room.
[[nodiscard]] std::vector<std::string> draw_measures(const Sheet& sheet, const PixelWindow& window,
                                                     std::span<const Measure> measures, Drawing& view);

}  // namespace splatray
