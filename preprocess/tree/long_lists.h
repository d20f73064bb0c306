/// Leaves that list many splats though they hold few centres.
#pragma once
#include <vector>

#include "preprocess/tree/insertion.h"
#include "preprocess/tree/octree.h"

namespace splatray {

/// A list of more than LONG_LIST * leaf_size splats is long; one of more than TOO_LONG_LIST * leaf_size needs another octree.
inline constexpr std::uint32_t LONG_LIST = 4;
inline constexpr std::uint32_t TOO_LONG_LIST = 8;

/// The leaves with long lists and, recursively, those of their children that have long lists; but for those at
/// MAX_DEPTH and those whose splats are wide for their children (are_wide), which would list mostly the same. `lists` are
/// those of policy `overlap`. None where no list is longer than TOO_LONG_LIST: a few leaves are not worth another insertion.
/// A sheet in a plane between cells needs it: on its other side lie cells that hold no centre and list all of it that they touch.
[[nodiscard]] std::vector<CellName> find_long_lists(const Octree& tree, const LeafLists& lists,
                                                    const SplatList& splats, std::uint32_t leaf_size);

}  // namespace splatray
