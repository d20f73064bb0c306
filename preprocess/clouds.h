/// The clouds of an input's objects, and what there is to say of them.
#pragma once
#include <string>
#include <vector>

#include "preprocess/build.h"
#include "preprocess/surface/cloud.h"

namespace splatray {

/// Takes the points of all objects (make_cloud); `names` are the objects'. Adds to the counts and notes of `stats`. Throws Error
/// (input_unreadable) where no point has a usable position.
[[nodiscard]] std::vector<Cloud> make_clouds(Input& input, const std::vector<std::string>& names,
                                             BuildStats& stats);

/// Throws Error (input_unreadable), which says what became of them, where no cloud has a point left.
void require_points(const std::vector<Cloud>& clouds, const BuildStats& stats);

/// Adds a note where objects are so small beside the scene that the lattice's step, world units, spoils their shape.
void note_coarse_objects(const std::vector<Cloud>& clouds, const std::vector<std::string>& names,
                         double step_world, BuildStats& stats);

}  // namespace splatray
