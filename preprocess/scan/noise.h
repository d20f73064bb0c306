/// How far points lie off their surface.
#pragma once
#include <cstdint>
#include <vector>

#include "preprocess/scan/survey.h"
#include "preprocess/surface/cloud.h"

namespace splatray {

/// The median, over the points, of how much they and their 8 nearest places disagree about the height of one over the other's
/// plane, over the distance to the 8th. Curvature cancels: (n_i + n_j).(p_j - p_i) is zero on circles. Neighbours whose
/// normals are more than 25 degrees apart are left out. Normals must be known, sides do not matter. 0 without points.
[[nodiscard]] double measure_noise(const Cloud& cloud, const Survey& survey);

}  // namespace splatray
