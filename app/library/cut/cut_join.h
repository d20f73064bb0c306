/// Curves that a plane cuts out of a surface, joined and simplified.
#pragma once
#include <vector>

#include "app/library/cut/cut_trace.h"

namespace splatray {

/// Joins the ends of curves that lie next to each other, the nearest first: at the corner where their straight continuations
/// meet, across a gap in one line, or straight across the end of a thin wall, where the surface has splats of it. What is shorter than
/// four radii is left out.
[[nodiscard]] std::vector<CutCurve> joined(const CutSurface& surface, const std::vector<TracedCurve>& curves);

/// The curve of the fewest of its points from which no other is farther than the tolerance (Douglas and Peucker 1973).
[[nodiscard]] CutCurve simplified(const CutCurve& curve, double tolerance);

}  // namespace splatray
