/// The true picture of a triangle mesh.
#pragma once
#include "engine/image/view.h"
#include "preprocess/points.h"
#include "tests/bench/truth/truth.h"

namespace splatray::testing {

/// The picture of the triangles, both faces seen, with the smooth normals that preprocess gives to points on them
/// (normal_on_triangle). Embree finds the triangle of each pixel in float32; distance, place in the triangle and normal are
/// computed again in float64.
[[nodiscard]] Truth mesh_truth(const Mesh& mesh, const View& view);

}  // namespace splatray::testing
