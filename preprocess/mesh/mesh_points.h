/// Objects of meshes -> objects of points.
#pragma once
#include "preprocess/points.h"

namespace splatray {

/// Turns every object's meshes (with triangles) into points: at vertices, or `options.samples` points over
/// all meshes of the input by area. With samples == 0, meshes too coarse for splats at their vertices
/// (is_coarse), or with textures too fine (is_finer_than_vertices), share about AUTOMATIC_SAMPLES points by area instead.
/// Triangles with a vertex that is not finite are dropped. A mesh without triangles is its vertices. Sets `oriented` and
/// `surface_area`; closed meshes of dielectrics, with options.turn_outwards of all objects, are turned so that normals point
/// outwards, all others stay as they were made. Meshes
/// are kept only with options.keep_meshes. What was decided is said in input.notes.
void points_from_meshes(Input& input, const ReadOptions& options);

/// Points shared by coarse meshes when no number of samples is asked for.
inline constexpr std::uint64_t AUTOMATIC_SAMPLES = 500000;

}  // namespace splatray
