/// The camera of a scene or view.
#pragma once
#include <glm/glm.hpp>

namespace splatray {

/// Camera in world space, float64. Right-handed; the image's top row is towards `up`.
struct Camera {
  glm::dvec3 eye{0.0, 0.0, 1.0};
  glm::dvec3 target{0.0};
  glm::dvec3 up{0.0, 1.0, 0.0};  ///< need not be orthogonal to the view direction, must not be parallel to it
  double fov_y_deg = 40.0;       ///< vertical field of view, (0, 180); ignored when ortho_height > 0
  double ortho_height = 0.0;     ///< world height of an orthographic picture; 0 = perspective
  /// Where the point straight ahead lies, from the picture's middle to the right and down, in widths and heights of the picture.
  glm::dvec2 lens_shift{0.0};
  double pixel_aspect = 1.0;  ///< a pixel's width over its height, > 0
  /// All directions around the eye (equirectangular): columns are longitudes about `up`, the target's in the middle and the right of it
  /// to its right, rows are latitudes, `up` at the top. A picture is twice as wide as high. Field of view, orthographic height, lens
  /// shift and pixel aspect are ignored.
  bool panorama = false;
  bool operator==(const Camera&) const = default;
};

}  // namespace splatray
