#include "engine/scene/leaf/slab.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "engine/scene/octahedral.h"
#include "shaders/layout.h"

namespace splatray {
namespace {

constexpr int AXIS_SCALE = static_cast<int>(SLAB_AXIS_SCALE);

/// Thickness that a slab's five bits say, in units of the cell's half size.
double slab_thickness(std::uint32_t bits) {
  return (1.0 + 0.25 * (bits & 3U)) * (1U << (bits >> 2)) / SLAB_THINNEST;
}

/// Splats in one of the parts that a leaf's halves are stored in.
std::uint32_t list_share(std::uint32_t listed) { return (listed + SLAB_SHARES - 1) / SLAB_SHARES; }

}  // namespace

glm::dvec3 nearest_slab_axis(const glm::dvec3& direction) {
  const glm::ivec2 oct = octahedral_nearest(direction.x < 0.0 ? -direction : direction, AXIS_SCALE);
  return octahedral_vector(oct.x, oct.y, AXIS_SCALE) / static_cast<double>(AXIS_SCALE);
}

std::uint32_t pack_slab(const Slab& slab, std::uint32_t listed) {
  assert(slab.low >= -1.0 && slab.low <= slab.high && slab.high <= 1.0);
  assert(slab.lower_end <= listed && slab.upper_begin <= listed);
  assert(slab.axis == nearest_slab_axis(slab.axis));
  const auto oct = glm::ivec2(glm::round(octahedral_exact(slab.axis, AXIS_SCALE)));
  const double low = std::min(std::floor(slab.low * SLAB_SCALE), SLAB_SCALE - 1.0);
  std::uint32_t thickness = 0;
  while (low / SLAB_SCALE + slab_thickness(thickness) < slab.high) ++thickness;
  const std::uint32_t share = list_share(listed);
  const std::uint32_t lower = std::max((slab.lower_end + share - 1) / share, 1U) - 1;
  const std::uint32_t upper = std::min(slab.upper_begin / share, SLAB_SHARES - 1);
  return static_cast<std::uint32_t>(oct.x) | static_cast<std::uint32_t>(oct.y + AXIS_SCALE) << 5 |
         static_cast<std::uint32_t>(low + SLAB_SCALE) << 11 | thickness << 19 | lower << 24 | upper << 28;
}

Slab unpack_slab(std::uint32_t word, std::uint32_t listed) {
  const int u = static_cast<int>(word & 31U);
  const int v = static_cast<int>(word >> 5 & 63U) - AXIS_SCALE;
  const double low = static_cast<double>(word >> 11 & 255U) / SLAB_SCALE - 1.0;
  const std::uint32_t share = list_share(listed);
  return {octahedral_vector(u, v, AXIS_SCALE) / static_cast<double>(AXIS_SCALE), low,
          low + slab_thickness(word >> 19 & 31U), std::min(share * ((word >> 24 & 15U) + 1), listed),
          std::min(share * (word >> 28), listed)};
}

int halved_axis(const glm::dvec3& slab_axis) {
  const glm::dvec3 along = glm::abs(slab_axis);
  if (along.x <= along.y && along.x <= along.z) return 0;
  return along.y <= along.z ? 1 : 2;
}

}  // namespace splatray
