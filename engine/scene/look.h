/// What objects are seen with: their lights. Their materials are of shaders/layout.h.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>

#include "shaders/layout.h"

namespace splatray {

/// A light in world space. Intensities are linear rgb.
struct SceneLight {
  std::uint32_t kind = LIGHT_DIRECTIONAL;  ///< LIGHT_*
  glm::dvec3 position{0.0, 1.0, 0.0};      ///< point, rectangle: centre; directional: unit vector towards it
  /// Directional: irradiance facing it; point: intensity (irradiance * distance^2); rectangle: radiance.
  glm::vec3 power{1.0F};
  /// point: radius, world units; directional: angular radius, radians; 0 = none. LOOK_PAPER knows none.
  double size = 0.0;
  /// Rectangle: half its edges, world units, perpendicular; it shines towards cross(u, v).
  glm::dvec3 edge_u{0.0}, edge_v{0.0};
  bool operator==(const SceneLight&) const = default;
};

/// Whether a light has a size.
[[nodiscard]] inline bool is_sized(const SceneLight& light) {
  return light.kind == LIGHT_RECTANGLE || light.size > 0.0;
}

/// Most dielectrics that a ray can be inside of at once.
inline constexpr std::uint32_t MASK_BITS = 32;

}  // namespace splatray
