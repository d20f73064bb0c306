/// Points drawn as squares, without a tracer: what is shown while there is nothing to trace.
#pragma once
#include <cstdint>
#include <vector>

#include "app/view/thread/point_cloud.h"
#include "engine/image/view.h"

namespace splatray {

/// How points are drawn.
struct PointStyle {
  double size = 1.0;                   ///< of a square, in spacings of the points
  double eye_dome = 1.0;               ///< as eye_dome has it
  bool cutaway = false;                ///< points that face away are not seen
  glm::u8vec3 background{38, 40, 44};  ///< display-encoded
};

/// Display-encoded rgba of each pixel of the whole picture, and the distance of what it shows along the view, world units;
/// +inf = nothing.
struct PointPicture {
  std::vector<std::uint8_t> rgba;
  std::vector<float> depth_world;
};

/// Draws points of a camera that make_frame_params takes.
[[nodiscard]] PointPicture draw_points(const PointCloud& points, const View& view, const PointStyle& style);

}  // namespace splatray
