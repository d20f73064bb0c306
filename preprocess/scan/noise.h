/// How far points lie off their surface.
#pragma once
#include <cstdint>
#include <vector>

#include "preprocess/scan/survey.h"
#include "preprocess/surface/cloud.h"

namespace splatray {

/// How far points of surfaces lie off these, of those whose normals were estimated: the median of how much a point and its 8
/// nearest places disagree about the height of one over the other's plane, over the distance to the 8th. Curvature cancels on
/// circles, where (n_i + n_j).(p_j - p_i) is zero. Neighbours whose normals are more than 25 degrees apart are left out. Sides
/// do not matter. No less than what rounding to the survey's step leaves: the step across the plane over the root of 12.
/// 0 without such points.
[[nodiscard]] double measure_noise(const Cloud& cloud, const Survey& survey);

/// The same as a length of each of the cloud's stations, world units, one where there are none: the standard deviation of
/// heights over the planes, of which two points' disagreement has the root of 2; 0 without such points.
[[nodiscard]] std::vector<double> station_noise_world(const Cloud& cloud, const Survey& survey);

/// What the coordinates of each station's points are multiples of, world units, along the axis where that is most
/// (coordinate_step). The cloud's positions must be there.
[[nodiscard]] std::vector<double> station_step_world(const Cloud& cloud);

/// What the places' coordinates are multiples of, along each axis, in cloud coordinates: the least difference among at most 65
/// 536 of them, which is next to nothing where they were not rounded. The cloud's positions must be there.
[[nodiscard]] glm::vec3 coordinate_step(const Cloud& cloud);

}  // namespace splatray
