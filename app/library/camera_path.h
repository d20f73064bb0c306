/// Cameras that move: along keys, or about an axis.
#pragma once
#include <cstdint>
#include <vector>

#include "engine/scene/scene.h"

namespace splatray {

/// Where a camera path passes at a frame.
struct CameraKey {
  Camera camera;
  std::uint32_t frame = 0;
};

/// At least one key, frames ascending, all perspective or all orthographic.
using CameraPath = std::vector<CameraKey>;

/// The camera at a frame in [first key's, last key's] (asserted). Catmull-Rom splines (Catmull and Rom 1974, "A Class of
/// Local Interpolating Splines") of eye, target, up, field of view and orthographic height in float64. Their knots are the
/// keys' frames: each key is met at its frame, and no speed jumps there, which centripetal knots would give up for
/// tighter curves; evenly spaced keys give the uniform spline.
[[nodiscard]] Camera camera_at(const CameraPath& path, std::uint32_t frame);

/// The camera turned about the axis `up` (any length > 0) through its target, counter-clockwise seen from above;
/// 1 turn is a full one.
[[nodiscard]] Camera turned_camera(const Camera& camera, const glm::dvec3& up, double turns);

}  // namespace splatray
