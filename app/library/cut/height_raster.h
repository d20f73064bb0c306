/// Heights of a scene's surface as it is seen from above.
#pragma once
#include <cstdint>
#include <vector>

#include "app/library/cut/plane_cut.h"

namespace splatray {

/// Heights at the centres of square cells.
struct HeightRaster {
  glm::dvec2 corner{0.0};  ///< outer corner of the top left cell, along CutPlane::right and top
  double cell = 1.0;       ///< its side, world units, > 0
  std::uint32_t width = 0, height = 0;
  std::vector<double> values;  ///< along CutPlane::toward, world units, top row first; NaN where nothing is

  [[nodiscard]] double at(std::uint32_t column, std::uint32_t row) const {
    return values[std::size_t{row} * width + column];
  }
};

/// Fills the values of a raster, whose other members are given: at each cell the mean, weighted by the distance from their centres, of the
/// discs that are there and whose centres the region holds, of those within their radius of the highest.
void fill_heights(const Scene& scene, const Region& region, const CutPlane& plane, HeightRaster& raster);

/// Smooths heights by a Gaussian of this standard deviation, in cells; where nothing is stays so, and a cell counts for another one only
/// where no step lies between them: where their heights differ by less than `step` for each cell of their distance.
void smooth_heights(double deviation, double step, HeightRaster& raster);

}  // namespace splatray
