/// Normals of projected points, from these points themselves, and the projection that follows from them.
#pragma once
#include <cstdint>
#include <vector>

#include "preprocess/base/parallel.h"
#include "preprocess/surface/cloud.h"

namespace splatray {

/// Which points are looked at again, and what is known of them.
struct Reprojection {
  const std::vector<std::uint8_t>& moves;  ///< of each point: != 0 where it is
  bool sided;                              ///< whether normals' sides are known
  double noise;                            ///< measure_noise
  const std::vector<float>& sheet_end;     ///< part_layers, of the places as they are now
};

/// Goes on where points were projected (smooth_points): means of normals lean where the surface ends or bends, the projected
/// points do not. The normal becomes the axis of the point and those of its 24 nearest on its sheet whose normals are within 40
/// degrees, so that edges stay, on its old side. Where the noise is above 0.2, as of scans in many layers, within 60, and the point
/// then goes onto their plane (by their covariance, weights exp(-2 d^2 / d24^2)), which adds to `lift`, and the normal becomes the axis again. The
/// cloud is out of order afterwards, but coincident points stay so.
void reproject_points(Cloud& cloud, const Reprojection& how, std::vector<float>& lift, const Stage& stage);

}  // namespace splatray
