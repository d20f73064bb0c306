/// The wide tree over a scene's splats, which programs on the host walk: 16 boxes and 16 splats at a time fit vector instructions, so a
/// ray is tested against many splats at once and need not wait for other rays (Wald, Benthin and Boulos 2008, "Getting Rid of
/// Packets"). Plain data alone, as wide_walk.h asks for.
#pragma once
#include <array>
#include <cstdint>

namespace splatray {

/// Children of a node, splats of a leaf.
inline constexpr std::uint32_t WIDE = 16;
/// Levels of nodes: 16^7 leaves hold more than 2^32 splats.
inline constexpr std::uint32_t WIDE_LEVELS = 7;

/// A number of each child or splat.
using WideFloats = std::array<float, WIDE>;

/// The boxes of a node's children, lattice units, a little too large, so that float32 loses no hit. Those that are not there
/// have a lower bound above the upper one.
struct WideNode {
  std::array<std::array<WideFloats, 2>, 3> bounds;  ///< of each axis, lower and upper
};
static_assert(sizeof(WideNode) == 384);

/// Where a tree has what. Leaf n, of level 0, has the splats WIDE n to WIDE n + WIDE - 1 of the data pool, child i of node n of a level
/// is node WIDE n + i of the level below: all are full but for the last of a level.
struct WideLevels {
  std::uint32_t levels = 0;  ///< of nodes; 0 = no splats
  /// The last of each level, and its splats or children, a bit each.
  std::array<std::uint32_t, WIDE_LEVELS + 1> last{}, last_mask{};
  /// Each level's first node among all; of the level of leaves none.
  std::array<std::uint32_t, WIDE_LEVELS + 1> begin{};
  std::uint32_t nodes = 0;  ///< of all levels
};

}  // namespace splatray
