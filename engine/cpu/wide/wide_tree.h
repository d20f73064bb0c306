/// The tree over splats that tracing on the host walks: 16 boxes and 16 splats at a time fit vector instructions, so a ray is
/// tested against many splats at once and need not wait for other rays (Wald, Benthin and Boulos 2008, "Getting Rid of
/// Packets").
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "engine/cpu/wide/wide_walk.h"
#include "shaders/layout.h"

namespace splatray {

/// All nodes but the last of a level have WIDE children, all leaves but the last WIDE splats, so that children are found by their
/// number: child i of node n of a level is node WIDE n + i of the level below. Immutable.
class WideTree {
 public:
  WideTree() = default;
  /// Builds the tree of a scene's data pool on `threads` threads, 0 = one a core. Sets `order` to the indices that its splats have there, leaf
  /// by leaf: so what is beside the data pool is to lie too. Takes 18 bytes a splat, their own words among them.
  WideTree(std::span<const uvec4> splats, unsigned threads, std::vector<std::uint32_t>& order);

  [[nodiscard]] WideView view() const;
  [[nodiscard]] std::uint64_t bytes() const;

 private:
  std::vector<WideLeaf> leaves_;
  std::vector<WideNode> nodes_;  ///< level by level, the lowest first
  WideView view_;                ///< but for the arrays
};

}  // namespace splatray
