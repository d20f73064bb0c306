/// Few straight parts for many points in a row.
#pragma once
#include <vector>

#include <glm/glm.hpp>

namespace splatray {

/// The corners of straight parts that the points, in their order, are at most about `tolerance` from: they are divided as by Douglas and
/// Peucker 1973, "Algorithms for the reduction of the number of points required to represent a digitized line or its caricature"; a
/// part is the line that fits its points best, and two parts meet where these lines cross. So corners of staircases and of points that
/// scatter lie nearer to the truth than any of the points. Parts in a row are one where their points swing about one line, at most 2.5
/// tolerances from it, often or in single juts, as the rims of discs do: points are about a unit apart. An open row keeps its ends to within the tolerance.
[[nodiscard]] std::vector<glm::dvec2> fitted_polyline(const std::vector<glm::dvec2>& points, bool closed,
                                                      double tolerance);

}  // namespace splatray
