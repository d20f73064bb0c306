/// Measures on a drawing: their points, lines and values.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "app/library/codec/drawing.h"
#include "app/library/measure/measure_words.h"
#include "app/library/shot/sheet.h"

namespace splatray {

/// What the sheet's measures share.
[[nodiscard]] MeasureFrame measure_frame(const Sheet& sheet);

/// What a view shows of measures.
struct ShownMeasures {
  std::vector<MeasureRow> rows;    ///< of those that are drawn
  std::vector<std::string> notes;  ///< sentences for the page
};

/// Draws the measures whose points all lie in the window on its view (sheet_view.h): lines as the paper has them, number and value, or the
/// number alone, where they cover no other text; numbers that find no room are in the notes.
[[nodiscard]] ShownMeasures draw_measures(const Sheet& sheet, const PixelWindow& window,
                                          std::span<const Measure> measures, Drawing& view);

}  // namespace splatray
