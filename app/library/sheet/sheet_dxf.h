/// A sheet as DXF.
#pragma once
#include <span>
#include <string>

#include "app/library/measure/measure.h"
#include "app/library/sheet/page_blocks.h"
#include "app/library/shot/sheet.h"

namespace splatray {

/// The whole sheet in its own coordinates (Sheet::at), a unit of the drawing being one of the file, with the layers CUT and HATCH, of what is cut, CONTOURS, LEVELS,
/// BEYOND, of what is seen, HIDDEN, dashed, of what is above, MEASURES, and TEXT: title, scale and notes below the drawing.
[[nodiscard]] std::string sheet_dxf(const Sheet& sheet, const PageWords& words,
                                    std::span<const Measure> measures);

/// Several sheets. An atlas has its floors at their coordinates, one over the other, each on layers of its own: FLOOR1-CUT and so on, from
/// the lowest. Views lie side by side with their captions, the first at its coordinates.
[[nodiscard]] std::string sheets_dxf(const SheetSet& set, const PageWords& words,
                                     std::span<const Measure> measures);

}  // namespace splatray
