/// Normals of projected points, from these points themselves, and the projection that follows from them.
#pragma once
#include <cstdint>
#include <vector>

#include "preprocess/base/parallel.h"
#include "preprocess/surface/cloud.h"

namespace splatray {

/// Goes on where points were projected (smooth_points): means of normals lean where the surface ends or bends, the projected
/// points do not. For those with `moves` != 0 the normal becomes the axis of the point and those of its 24 nearest whose normals
/// are within 40 degrees, so that edges stay, on its old side. Where `noise` (measure_noise) is above 0.2, as of scans in many
/// layers, the point then goes onto their plane (by their covariance, weights exp(-2 d^2 / d24^2)), which adds to `lift`, and
/// the normal becomes the axis again. `sided` when normals' sides are known. The cloud is out of order afterwards, but
/// coincident points stay so.
void reproject_points(Cloud& cloud, const std::vector<std::uint8_t>& moves, std::vector<float>& lift,
                      bool sided, double noise, const Stage& stage);

}  // namespace splatray
