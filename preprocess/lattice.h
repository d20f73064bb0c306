/// Points that were splats, and are to be the same splats again.
#pragma once
#include <optional>
#include <vector>

#include "engine/scene/scene.h"
#include "preprocess/surface/cloud.h"

namespace splatray {

/// The root of the scene that the points were splats of: where they are one object, have normals and radii, lie on its lattice
/// and within its root, and `params` change nothing. Else nothing, and the clouds forget their words, which mean nothing then.
[[nodiscard]] std::optional<RootTransform> kept_lattice(std::vector<Cloud>& clouds,
                                                        const BuildParams& params);

}  // namespace splatray
