/// The slabs of a scene's leaves: what lets a ray pass by a leaf's splats without testing them.
#pragma once
#include <cstdint>
#include <vector>

#include "engine/host/scene.h"
#include "preprocess/parallel.h"

namespace splatray {

/// The slab of every filled leaf (layout.h), from its cell and list: across the mean of the discs' normals, and as thin as
/// holds what they have inside the cell. What they have up to LIST_INFLATION outside the cell is no farther than that from
/// the slab. Only node_pool, begin_end, reference_pool and data_pool are looked at.
[[nodiscard]] std::vector<std::uint32_t> leaf_slabs(const Scene& scene, const Stage& stage);

}  // namespace splatray
