/// The centre rays of a picture, in float64.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>

#include "engine/image/view.h"

namespace splatray::testing {

/// Rays through pixel centres in float64 (perspective cameras).
class PixelRays {
 public:
  explicit PixelRays(const View& view);
  [[nodiscard]] const glm::dvec3& eye_world() const { return eye_; }
  /// Unit direction through the centre of the pixel in column x of row y, row 0 on top.
  [[nodiscard]] glm::dvec3 dir_world(std::uint32_t x, std::uint32_t y) const;
  /// Width of a pixel at the distance of the camera's target, world units.
  [[nodiscard]] double pixel_width_world() const { return pixel_width_; }

 private:
  glm::dvec3 eye_, corner_, right_, down_;
  double pixel_width_;
};

}  // namespace splatray::testing
