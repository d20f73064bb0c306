/// A ray's way through the wide tree. Plain data alone: it is compiled for several processors (wide_step.h), and a function of a
/// library that one of these compiled first could be taken for all.
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

/// The boxes of a node's children, lattice units, a little too large, so that float32 loses no hit. Those that are not there have a
/// lower bound above the upper one.
struct alignas(64) WideNode {
  std::array<std::array<WideFloats, 2>, 3> bounds;  ///< of each axis, lower and upper
};

/// Splats as the test in float32 reads them.
struct alignas(64) WideLeaf {
  std::array<WideFloats, 3> center;  ///< lattice units, exact
  std::array<WideFloats, 3> normal;  ///< integers, exact: |x| + |y| + |z| = OCT_SCALE
  WideFloats radius_squared;         ///< lattice units^2
  std::array<std::uint32_t, WIDE> splat;  ///< indices in the data pool
};

/// The tree as a walk reads it.
struct WideView {
  const WideNode* nodes = nullptr;
  const WideLeaf* leaves = nullptr;
  std::array<std::uint32_t, WIDE_LEVELS + 1> level_begin{};  ///< level n's first node; of the level of leaves, 0, none
  std::uint32_t levels = 0;     ///< of nodes; 0 = no splats
  std::uint32_t last_leaf = 0;
  std::uint32_t last_mask = 0;  ///< its splats, a bit each
};

/// A box that a ray meets at t.
struct WideBox {
  float t;
  std::uint32_t level;   ///< 0 = a leaf
  std::uint32_t number;  ///< in its level
};

/// Where a ray is.
struct WideWalk {
  std::array<float, 3> origin;   ///< root space
  std::array<float, 3> dir;
  std::array<float, 3> inverse;  ///< 1 / dir, finite
  float t_min;
  float t_max;                   ///< nothing behind it is looked for; may become less between steps
  std::uint32_t boxes_met = 0;   ///< on the stack; at first the root alone
  std::array<WideBox, (WIDE - 1) * WIDE_LEVELS + 1> stack;  ///< of each node the nearest last
  std::uint32_t nodes = 0;       ///< looked at
  std::uint32_t leaves = 0;      ///< tested
};

/// Splats of a leaf that a ray may hit.
struct WideStep {
  const WideLeaf* leaf;
  std::uint32_t candidates;  ///< a bit each; none where the walk has ended
};

/// Goes on to the next leaf that may have hits with t in [t_min, t_max).
using WideStepper = WideStep (*)(const WideView& tree, WideWalk& walk);

/// The fastest that this processor runs.
[[nodiscard]] WideStepper wide_stepper();

}  // namespace splatray
