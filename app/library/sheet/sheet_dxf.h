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

}  // namespace splatray
