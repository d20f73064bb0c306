/// How far points lie off their surface.
#pragma once
#include <cstdint>
#include <vector>

#include "preprocess/scan/survey.h"
#include "preprocess/surface/cloud.h"

namespace splatray {

/// How far points off their surface lie, of those whose normals were estimated: the median of how much a point and its 8 nearest
/// places disagree about the height of one over the other's plane, over the distance to the 8th. Curvature cancels on circles,
/// where (n_i + n_j).(p_j - p_i) is zero. Neighbours whose normals are more than 25 degrees apart are left out. Sides do not matter. 0 without such points.
[[nodiscard]] double measure_noise(const Cloud& cloud, const Survey& survey);

}  // namespace splatray
