/// Which splats each leaf lists.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "preprocess/base/parallel.h"
#include "preprocess/tree/octree.h"

namespace splatray {

/// Leaf i of the octree lists splats splat[begin[i] .. begin[i + 1]), ascending. An empty leaf may list
/// splats: it becomes filled.
struct LeafLists {
  std::vector<std::uint32_t> begin;  ///< leaves + 1 entries
  std::vector<std::uint32_t> splat;
};

/// Policy `centre`: each splat in the leaf that holds its centre.
[[nodiscard]] LeafLists insert_centres(const Octree& tree, const SplatList& splats);

/// Policy `overlap`: each splat in every leaf whose cell it comes within LIST_INFLATION of, before its clip lines, and in no
/// others. Throws Error (failed) above 2^32 - 1 references, and (usage) above both 2^24 and 100 a splat.
[[nodiscard]] LeafLists insert_overlaps(const Octree& tree, const SplatList& splats, const Stage& stage);

/// The leaves that splats [begin, end) are listed in by policy `overlap`, splat by splat, as indices into the tree's leaves.
[[nodiscard]] std::vector<std::uint32_t> leaves_met(const Octree& tree, const SplatList& splats,
                                                    std::size_t begin, std::size_t end);

/// Policy `probe` (Goradia et al. 2010, sec. III-C), given the lists of `overlap`: `probes` segments from a
/// random point on a face of each leaf's cell to a random point on another face; where a segment hits no
/// splat whose centre the leaf holds, the others it hits stay in the list. Leaves that hold no centre are
/// probed too and become filled when a segment hits a splat. Each leaf has its own random numbers, from
/// `seed` and its Morton key.
[[nodiscard]] LeafLists keep_probed(const Octree& tree, const SplatList& splats, const LeafLists& overlaps,
                                    std::uint32_t probes, std::uint64_t seed, const Stage& stage);

}  // namespace splatray
