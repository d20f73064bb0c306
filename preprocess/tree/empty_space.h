/// How far the empty space around empty leaves reaches.
#pragma once
#include "engine/scene/scene.h"
#include "preprocess/base/parallel.h"

namespace splatray {

/// Gives every empty leaf of the node pool a box without filled leaves around its cell (layout.h), so that rays leave it in one
/// step (macro-regions: Devillers 1989, "The Macro-Regions: an Efficient Space Subdivision Structure for Ray Tracing"). The box
/// grows by one side after the other, as long as any may. Needs Begin-End's leaves to be in the node pool; the result does not
/// depend on threads. Throws Error (interrupted).
void grow_empty_leaves(Scene& scene, const Stage& stage);

}  // namespace splatray
