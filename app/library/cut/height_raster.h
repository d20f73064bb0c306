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

/// What the noise of discs does to a raster's heights.
struct HeightNoise {
  /// Root of the mean square of what a disc's height differs from the others' in its cell, world units.
  double residual = 0.0;
  /// For each list of factors the variance of the sum of factor times height, world units to the power that they have.
  std::vector<double> variances;
};

/// The noise of a raster as fill_heights filled it, for sums with these factors, one for each cell: each disc's height is off on its own,
/// by what it differs from the mean of the others (White 1980, "A heteroskedasticity-consistent covariance matrix estimator", with the
/// leverage of each left out), or by `noise_world`, a standard deviation, where that says more, as of points that were smoothed.
[[nodiscard]] HeightNoise height_noise(const Scene& scene, const Region& region, const CutPlane& plane,
                                       const HeightRaster& raster,
                                       const std::vector<std::vector<double>>& factors, double noise_world);

/// Gives cells without a height that have others in all eight directions one from these, by their distances. Returns for each cell half
/// of what these differ by, over the square root of 3; 0 where it had a height, NaN where it has none.
[[nodiscard]] std::vector<double> fill_holes(HeightRaster& raster);

/// Smooths heights by a Gaussian of this standard deviation, in cells; where nothing is stays so, and a cell counts for another one only
/// where no step lies between them: where their heights differ by less than `step` for each cell of their distance.
void smooth_heights(double deviation, double step, HeightRaster& raster);

}  // namespace splatray
