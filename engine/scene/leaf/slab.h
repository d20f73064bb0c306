/// A leaf's slab and halves, and how a word holds them. shaders/layout.h draws it.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>

namespace splatray {

/// A leaf's slab and halves (layout.h): low <= axis.(p - centre) / half size <= high.
struct Slab {
  glm::dvec3 axis;            ///< |x| + |y| + |z| = 1, x >= 0
  double low;                 ///< in units of the cell's half size, [-1, 1]
  double high;                ///< >= low
  std::uint32_t lower_end;    ///< splats [0, lower_end) of the leaf's list hold all that reach the lower half
  std::uint32_t upper_begin;  ///< splats [upper_begin, listed) hold all that reach the upper half
};

/// The nearest axis that a slab may have to a direction, of any length but 0, or to its opposite.
[[nodiscard]] glm::dvec3 nearest_slab_axis(const glm::dvec3& direction);

/// Packs the slab of a leaf that lists `listed` splats, >= 1; its axis must be one that slabs may have, all else turns
/// outwards.
[[nodiscard]] std::uint32_t pack_slab(const Slab& slab, std::uint32_t listed);
/// The reference implementation of the decoding; `high` may be above 1.
[[nodiscard]] Slab unpack_slab(std::uint32_t word, std::uint32_t listed);

/// The coordinate axis across which a leaf with this slab axis is halved: 0 x, 1 y, 2 z.
[[nodiscard]] int halved_axis(const glm::dvec3& slab_axis);

}  // namespace splatray
