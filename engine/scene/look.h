/// What objects look like, and the lights they are seen by. Materials are of shaders/layout.h.
#pragma once
#include <array>
#include <cstdint>
#include <cstring>
#include <glm/glm.hpp>
#include <vector>

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
  /// Point: where it shines if it is a spot, any length > 0; zero: all around.
  glm::dvec3 spot_axis{0.0};
  /// Spot: angles about its axis within which it is as bright as ahead, and without which it is dark; radians, 0 <= inner < outer
  /// <= pi / 2. Between, and at its range, light falls off as KHR_lights_punctual has it.
  double spot_inner = 0.0, spot_outer = 0.0;
  double range = 0.0;  ///< point: how far it shines, world units; 0: as far as there is anything
  bool operator==(const SceneLight&) const = default;
};

/// Flat lights lie within the rectangle of their edges and shine towards cross(u, v). The area of each kind of them, in units of
/// that vector's length, from LIGHT_RECTANGLE on: flat kinds come last.
inline constexpr std::array FLAT_AREAS = {4.0};

/// The last LIGHT_*.
inline constexpr std::uint32_t LIGHT_KIND_LAST = LIGHT_RECTANGLE + FLAT_AREAS.size() - 1;

/// Whether lights of a kind are flat.
[[nodiscard]] constexpr bool is_flat(std::uint32_t kind) { return kind >= LIGHT_RECTANGLE; }

/// A flat kind's number of FLAT_AREAS.
[[nodiscard]] constexpr double flat_area(std::uint32_t kind) { return FLAT_AREAS.at(kind - LIGHT_RECTANGLE); }

/// Whether a light has a size.
[[nodiscard]] inline bool is_sized(const SceneLight& light) {
  return is_flat(light.kind) || light.size > 0.0;
}

/// Whether a light is a spot.
[[nodiscard]] inline bool is_spot(const SceneLight& light) { return light.spot_axis != glm::dvec3(0.0); }

/// Whether two lists are equal bit for bit.
template <class Element>
[[nodiscard]] bool same_bytes(const std::vector<Element>& a, const std::vector<Element>& b) {
  if (a.size() != b.size()) return false;
  return a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(Element)) == 0;
}

/// Most dielectrics that a ray can be inside of at once.
inline constexpr std::uint32_t MASK_BITS = 32;

}  // namespace splatray
