/// Lines where what a sheet shows ends or turns, as a draughtsman draws them.
#pragma once
#include <span>
#include <vector>

#include "app/library/shot/sheet.h"

namespace splatray {

/// The lines along which what is seen steps in depth, ends or turns, but beside what is cut (beside_cut), along right and top. They are
/// joined, also across gaps no longer than the shortest of them, and straight to the radius of a disc, but at least to a pixel: rims of discs are not the surface's. Short ones are left out, as no more than a
/// few discs make them. `aov`: what the rays through all the sheet's pixels' centres hit, top row first.
[[nodiscard]] std::vector<CutCurve> seen_lines(const Sheet& sheet, std::span<const AovPixel> aov);

/// What is above the cut of a sheet as a sheet of its own, seen from below, of the same pixels.
[[nodiscard]] Sheet overhead_sheet(const Sheet& sheet);
/// Lines of that sheet in the coordinates of the sheet below it.
[[nodiscard]] std::vector<CutCurve> mirrored(std::vector<CutCurve> curves);

/// A curve as dashes (page_style.h), each of them open.
[[nodiscard]] std::vector<CutCurve> dashed(const CutCurve& curve, double mm_world);

}  // namespace splatray
