/// Primary rays as shaders form them.
#pragma once
#include <glm/glm.hpp>

#include "shaders/layout.h"

namespace splatray {

/// A primary ray in root space, float32.
struct PixelRay {
  glm::vec3 point, dir;
  float eye_distance;  ///< of the ray point, along the ray
};

inline PixelRay pixel_ray(const FrameParams& frame, float px, float py) {
  const glm::vec3 dir = frame.dir_00 + px * frame.dir_dx + py * frame.dir_dy;
  return {frame.origin_00 + px * frame.origin_dx + py * frame.origin_dy, dir,
          frame.depth_offset + frame.depth_per_dir * glm::length(dir)};
}

}  // namespace splatray
