/// How large leaves are by default.
#pragma once
#include "engine/scene/pool/copies.h"
#include "preprocess/tree/octree.h"

namespace splatray {

/// What a scene of splats would hold with leaves of this size and policy `overlap`: exact up to 32,768 splats, else estimated
/// from 32,768, which are taken evenly from the list in pieces of 256.
[[nodiscard]] PoolCounts estimate_counts(const SplatList& splats, std::uint32_t leaf_size);

/// The first of 16 and 24 with which copies of the leaves' splats are estimated to fit (copies_fit), else 8: larger leaves list
/// a splat less often, and where references are needed leaves may as well be small, so that rays follow few. With policy
/// `probe` lists are at most as long as estimated; `centre` lists a splat once, which always fits.
[[nodiscard]] std::uint32_t choose_leaf_size(const SplatList& splats, Insertion insertion);

}  // namespace splatray
