/// Lines that are drawn twice.
#pragma once
#include <vector>

#include "app/library/cut/plane_cut.h"

namespace splatray {

/// The curves, the longest first, without those of which more than half lies within `near` of longer ones: edges that are nearer to each
/// other than what blurs them are one. World units, > 0.
[[nodiscard]] std::vector<CutCurve> without_doubles(std::vector<CutCurve> curves, double near);

/// The length of a curve, all around where it is closed.
[[nodiscard]] double curve_length(const CutCurve& curve);

}  // namespace splatray
