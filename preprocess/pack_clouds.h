/// From points with normals and radii to splats.
#pragma once
#include <vector>

#include "engine/scene/scene.h"
#include "preprocess/base/parallel.h"
#include "preprocess/surface/cloud.h"
#include "preprocess/tree/octree.h"

namespace splatray {

/// Packs all objects' points, which are then freed. Objects without colours are white where others have some; normal fields are
/// left out where all discs are flat, clip lines where all are whole. With `number_points` SplatList::point counts the points of
/// all objects, one object after the other.
[[nodiscard]] SplatList pack_clouds(std::vector<Cloud> clouds, const RootTransform& root, bool number_points,
                                    const Stage& stage);

}  // namespace splatray
