/// The slabs and halves of a scene's leaves: what lets a ray pass by a leaf's splats without testing them.
#pragma once
#include "engine/scene/scene.h"
#include "preprocess/base/parallel.h"

namespace splatray {

/// Fills the pool of slabs (layout.h) from the leaves' cells and lists, which it puts in the order of their halves. A slab lies
/// across the mean of the discs' normals and is as thin as holds what they have inside the cell; what they have up to
/// LIST_INFLATION outside the cell is no farther than that from the slab. Only node_pool, begin_end, reference_pool and
/// data_pool are looked at.
void add_slabs(Scene& scene, const Stage& stage);

}  // namespace splatray
