/// Where what is seen on a sheet changes from a pixel to the next (Saito, Takahashi 1990, "Comprehensible Rendering of 3-D Shapes").
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "app/library/shot/sheet.h"

namespace splatray {

class Edges {
 public:
  /// Takes a sheet and what the rays through its pixels' centres hit.
  Edges(const Sheet& sheet, std::span<const AovPixel> aov)
      : aov_(aov),
        right_(sheet.right),
        top_(sheet.top),
        toward_(sheet.toward),
        pixel_(static_cast<float>(sheet.pixel_world)) {}

  /// By how many pixels' size the depth steps between two pixels beyond what the slope of either surface gives, the second one (dx, dy) of
  /// them to the right and up; infinite where something ends, or another object begins.
  [[nodiscard]] float step(std::size_t a, std::size_t b, float dx, float dy) const {
    const AovPixel &first = aov_[a], &second = aov_[b];
    if (first.object != second.object) return INFINITY;
    if (first.object == NO_OBJECT) return 0.0F;
    const float step = second.z - first.z;
    return std::min(std::abs(step - slope(first, dx, dy)), std::abs(step - slope(second, dx, dy))) / pixel_;
  }

  /// Where on the way from one pixel to another of the same object, 0 to 1, the planes of their surfaces meet; not finite where they do
  /// not.
  [[nodiscard]] float crease(std::size_t a, std::size_t b, float dx, float dy) const {
    const AovPixel &first = aov_[a], &second = aov_[b];
    const float before = slope(first, dx, dy), behind = slope(second, dx, dy);
    return (second.z - first.z - behind) / (before - behind);
  }
  /// Whether both show one object.
  [[nodiscard]] bool show_one(std::size_t a, std::size_t b) const {
    return aov_[a].object == aov_[b].object && aov_[a].object != NO_OBJECT;
  }
  /// Cosine between the normals of two pixels.
  [[nodiscard]] float cosine(std::size_t a, std::size_t b) const {
    return glm::dot(aov_[a].normal, aov_[b].normal);
  }

 private:
  /// Steepest surface, as the cosine towards the paper, whose slope is followed.
  static constexpr float STEEPEST = 0.1F;

  /// What the depth of the surface changes by over a step on the paper.
  [[nodiscard]] float slope(const AovPixel& at, float dx, float dy) const {
    const float facing = glm::dot(at.normal, toward_);
    const float across = glm::dot(at.normal, right_) * dx + glm::dot(at.normal, top_) * dy;
    return across / std::copysign(std::max(std::abs(facing), STEEPEST), facing) * pixel_;
  }

  std::span<const AovPixel> aov_;
  vec3 right_, top_, toward_;
  float pixel_;
};

inline constexpr float EDGE_STEP = 6.0F;       ///< of depth that is a line, pixels
inline constexpr float CREASE_COSINE = 0.77F;  ///< between normals that make one: of 40 degrees

}  // namespace splatray
