/// The parts of curves that a rectangle shows.
#pragma once
#include <vector>

#include "app/library/cut/plane_cut.h"

namespace splatray {

/// The parts of a curve between two corners of a rectangle, `low` < `high`: the curve itself where all of it is, else open parts that end at
/// the border (Liang and Barsky 1984, "A new concept and method for line clipping", for each of its straight lines).
[[nodiscard]] std::vector<CutCurve> curve_within(const CutCurve& curve, const glm::dvec2& low,
                                                 const glm::dvec2& high);

}  // namespace splatray
