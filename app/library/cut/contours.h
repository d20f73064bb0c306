/// Lines of equal height.
#pragma once
#include <vector>

#include "app/library/cut/height_raster.h"

namespace splatray {

struct Contour {
  double height = 0.0;  ///< a whole number of intervals, world units
  CutCurve curve{};     ///< the higher side is to the right
};

/// The contours of a raster of heights, every `interval` from height 0 on, by marching squares (Lorensen and Cline 1987, in the plane).
/// None goes through a cell over which heights differ by more than `step`, where a surface ends above another. `interval` > 0.
[[nodiscard]] std::vector<Contour> contours_of(const HeightRaster& raster, double interval, double step);

}  // namespace splatray
