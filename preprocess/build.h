/// Input -> Scene: repair, normals, radii, octree, insertion. The whole preprocess but for reading and
/// writing files.
#pragma once
#include "engine/base/progress.h"
#include "engine/scene/scene.h"
#include "preprocess/build_stats.h"
#include "preprocess/points.h"

namespace splatray {

/// Builds the scene. A point without a neighbour at another place gets a radius of 1/100 of the diagonal of all centres, 1 world
/// unit where that is zero. An object none of whose normals is given becomes two-sided unless it is a dielectric. Dielectrics get
/// their mask bits in order; from the 33rd on they share them. The scene depends neither on the order of an object's points nor
/// on threads: `threads` 0 = all cores; Throws Error (input_unreadable) when no point is left, there are more than 65536 objects,
/// or a material or light is out of range, (interrupted) when `progress` says so, (failed) when 32-bit addresses do not suffice.
[[nodiscard]] Scene build_scene(Input input, const BuildParams& params, unsigned threads, BuildStats& stats,
                                const Progress& progress = {});

}  // namespace splatray
