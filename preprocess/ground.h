/// --ground: something for shadows to fall on.
#pragma once
#include <vector>

#include "engine/scene/scene.h"
#include "preprocess/surface/cloud.h"

namespace splatray {

/// Adds an object "ground" behind the others: large grey discs across the scene's up direction, ten times the scene's diagonal wide, by
/// a five-thousandth of it below the lowest point. The scene has its bounds, which stay, and the clouds are those of its objects.
void add_ground(std::vector<Cloud>& clouds, Scene& scene);

}  // namespace splatray
