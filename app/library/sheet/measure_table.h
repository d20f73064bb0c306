/// The table of the measures that a page shows.
#pragma once
#include <span>

#include "app/library/codec/drawing.h"
#include "app/library/measure/measure_words.h"

namespace splatray {

/// Number, name, kind, value, interval and unit of the main value of each measure, of points all coordinates, of volumes all values; in as many columns side
/// by side as there is room for. Names are wrapped. Without rows it is empty.
[[nodiscard]] Drawing measure_table(std::span<const MeasureRow> rows, double width_mm);

}  // namespace splatray
