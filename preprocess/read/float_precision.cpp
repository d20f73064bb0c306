#include "preprocess/read/float_precision.h"

#include <algorithm>
#include <cmath>

namespace splatray {

void note_float_precision(const Points& points, const std::filesystem::path& path,
                          const ReadListener& listener) {
  glm::dvec3 low(INFINITY);
  glm::dvec3 high(-INFINITY);
  for (const glm::dvec3& p : points.position) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  const double largest = std::max(glm::length(low), glm::length(high));
  if (largest * std::ldexp(1.0, -24) > 1e-5 * glm::length(high - low)) {
    listener.note(
        path,
        "coordinates are read as float32, which blurs them this far from the origin; save a PLY with "
        "double x, y, z to keep them");
  }
}

}  // namespace splatray
