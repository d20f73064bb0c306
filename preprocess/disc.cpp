#include "preprocess/disc.h"

#include <cmath>

namespace splatray {

Disc::Disc(const Splat& splat)
    : center(splat.center),
      normal(splat.normal),
      half_box(std::sqrt(splat.radius_squared) * glm::sqrt(glm::max(1.0 - splat.normal * splat.normal, 0.0))),
      radius_squared(splat.radius_squared) {}

}  // namespace splatray
