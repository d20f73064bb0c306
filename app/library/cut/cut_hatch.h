/// Hatching of what a plane cuts.
#pragma once
#include <array>
#include <span>
#include <vector>

#include "app/library/cut/plane_cut.h"

namespace splatray {

/// How what is cut is hatched, world units.
struct HatchStyle {
  double spacing = 0.0;  ///< between lines, > 0
  double stub = 0.0;     ///< length of lines on the back of a curve where what lies behind is not known
  /// Greatest distance between the backs of two curves that a wall is known to fill.
  double thickest = 0.0;
  glm::dvec2 along{1.0, 1.0};  ///< direction of the lines, any length > 0
};

/// Parallel lines: across what lies between the backs of curves (CutCurve: the front is to the left), as the inside of a pillar or of a
/// wall that was scanned from both sides, and stubs on the back of other curves. Curves shorter than `thickest` that are open have none.
[[nodiscard]] std::vector<std::array<glm::dvec2, 2>> cut_hatch(std::span<const CutCurve> curves,
                                                               const HatchStyle& style);

}  // namespace splatray
