/// What a sensor saw from its place, as a picture of it is framed.
#pragma once
#include <glm/glm.hpp>

#include "engine/image/point_sample.h"
#include "engine/image/view.h"

namespace splatray {

/// Vertical field of view at most of what a sensor saw, degrees.
inline constexpr double SENSOR_MOST_DEG = 100.0;
/// By how much a depth camera's picture is cropped at most, where the one made is wider.
inline constexpr double CROP_MOST = 1.4;

/// Turns a camera in the place of a sensor whose picture is full, or a band of three times its height that is full at both ends, to the
/// picture's middle, and crops that to the shape of the one made, by CROP_MOST at most, bands by 2; else leaves it and returns false.
bool fill_with_frame(const PointSample& sample, double aspect, Camera& camera);

}  // namespace splatray
