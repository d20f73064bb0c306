/// A splat and its words: how 128 bits, a colour and a normal field are packed. shaders/layout.h draws the words.
#pragma once
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "engine/scene/octahedral.h"
#include "shaders/layout.h"

namespace splatray {

/// A splat in full precision, root space; what 128 bits decode to.
struct Splat {
  glm::dvec3 center;      ///< lattice units, integers
  glm::dvec3 normal;      ///< unit
  double radius_squared;  ///< lattice units^2
  std::uint32_t object;
};

/// Packs a splat: centre rounded to the lattice (must lie in [0, 2^21 - 1]), normal to 16-bit octahedral,
/// squared radius rounded up. Asserts on non-finite input and on an object index above OBJECT_MASK.
[[nodiscard]] uvec4 pack_splat(const Splat& splat);
/// Its squared radius alone.
[[nodiscard]] inline double unpack_radius_squared(const uvec4& words) {
  constexpr std::uint32_t EXPONENT_BIT = 0x40000000U;  // set in every stored float32: r^2 >= 2
  return std::bit_cast<float>(EXPONENT_BIT | words.w >> 16 << 14);
}
/// Its centre alone, lattice units, integers.
[[nodiscard]] inline glm::dvec3 unpack_center(const uvec4& words) {
  return {static_cast<int>(words.x >> 11), static_cast<int>((words.x & 0x7FFU) << 10 | words.y >> 22),
          static_cast<int>(words.y & 0x1FFFFFU)};
}
/// Its normal as it is stored: integers, |x| + |y| + |z| = OCT_SCALE.
[[nodiscard]] inline glm::dvec3 unpack_stored_normal(const uvec4& words) {
  constexpr int SCALE = OCT_SCALE;
  return octahedral_vector(static_cast<int>(words.z & 0xFFFFU) - SCALE,
                           static_cast<int>(words.z >> 16) - SCALE, SCALE);
}
/// The exact splat of 128 bits. The reference implementation of the decoding, in float64; without branches, for loops.
[[nodiscard]] inline Splat unpack_splat(const uvec4& words) {
  const glm::dvec3 normal = unpack_stored_normal(words);
  return {unpack_center(words), normal * (1.0 / std::sqrt(glm::dot(normal, normal))),
          unpack_radius_squared(words), words.w & OBJECT_MASK};
}

/// 8 bits a channel, square-root encoded: byte = round(255 sqrt(linear)); r lowest, then g, b, a = 255.
[[nodiscard]] std::uint32_t pack_color(glm::vec3 linear);
[[nodiscard]] glm::vec3 unpack_color(std::uint32_t color);

/// Two unit vectors that with the unit `normal` make a right-handed orthonormal basis (Duff et al. 2017, "Building an
/// Orthonormal Basis, Revisited").
struct TangentFrame {
  explicit TangentFrame(const glm::dvec3& normal);
  glm::dvec3 u, v;
};

/// The normal field of a splat (layout.h): `slope` maps an offset on the disc, in units of the radius, to the change of
/// the unit normal. Symmetric; what it does along the normal is ignored; entries beyond 1/2 are clamped.
[[nodiscard]] std::uint32_t pack_field(const glm::dmat3& slope, const glm::dvec3& normal);
/// The reference implementation of the decoding; `normal` is the splat's own, as unpack_splat gives it. Zero of a constant term.
[[nodiscard]] glm::dmat3 unpack_field(std::uint32_t field, const glm::dvec3& normal);

/// A constant term in the place of the field: `lean` is added to the unit normal all over the disc. What of it is along the
/// normal is ignored, components beyond 1 are clamped.
[[nodiscard]] std::uint32_t pack_lean(const glm::dvec3& lean, const glm::dvec3& normal);
/// Likewise. Zero of a field.
[[nodiscard]] glm::dvec3 unpack_lean(std::uint32_t field, const glm::dvec3& normal);
/// Whether some of these normal fields are constant terms.
[[nodiscard]] bool any_leans(std::span<const std::uint32_t> fields);

}  // namespace splatray
