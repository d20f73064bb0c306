/// Morton (Z-order) keys of lattice points: bit 3i is bit i of x, 3i + 1 of y, 3i + 2 of z, as the octree's
/// children.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>

namespace splatray {

/// Moves bit i of a 21-bit number to bit 3i.
[[nodiscard]] inline std::uint64_t spread_bits(std::uint64_t bits) {
  bits = (bits | bits << 32) & 0x001F00000000FFFFULL;
  bits = (bits | bits << 16) & 0x001F0000FF0000FFULL;
  bits = (bits | bits << 8) & 0x100F00F00F00F00FULL;
  bits = (bits | bits << 4) & 0x10C30C30C30C30C3ULL;
  return (bits | bits << 2) & 0x1249249249249249ULL;
}

/// Inverse of spread_bits; other bits than 3i are ignored.
[[nodiscard]] inline std::uint32_t gather_bits(std::uint64_t bits) {
  bits &= 0x1249249249249249ULL;
  bits = (bits | bits >> 2) & 0x10C30C30C30C30C3ULL;
  bits = (bits | bits >> 4) & 0x100F00F00F00F00FULL;
  bits = (bits | bits >> 8) & 0x001F0000FF0000FFULL;
  bits = (bits | bits >> 16) & 0x001F00000000FFFFULL;
  return static_cast<std::uint32_t>((bits | bits >> 32) & 0x1FFFFFULL);
}

/// Key of a point with coordinates in [0, 2^21).
[[nodiscard]] inline std::uint64_t morton_key(glm::uvec3 point) {
  return spread_bits(point.x) | spread_bits(point.y) << 1 | spread_bits(point.z) << 2;
}

/// Point of a key; inverse of morton_key.
[[nodiscard]] inline glm::uvec3 morton_point(std::uint64_t key) {
  return {gather_bits(key), gather_bits(key >> 1), gather_bits(key >> 2)};
}

}  // namespace splatray
