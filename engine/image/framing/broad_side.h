/// The side of a thing that shows most of it.
#pragma once
#include <glm/glm.hpp>

#include "engine/image/point_sample.h"

namespace splatray {

/// From where a thing is looked at, degrees from the front towards its right: DEFAULT_AZIMUTH_DEG, unless its silhouette from there is
/// less than 0.72 of the widest one, as that of a guitar or a facade from its edge. Then the azimuth nearest to that one from
/// which 85 % of the widest is seen, and which the points' normals face where they face one side. Fewer than 100 points stay. `axes` as upright_axes has them.
[[nodiscard]] double broad_azimuth_deg(const PointSample& sample, const glm::dmat3& axes);

}  // namespace splatray
