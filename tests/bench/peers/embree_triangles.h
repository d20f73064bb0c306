/// A mesh in Embree.
#pragma once
#include "preprocess/points.h"
#include "tests/bench/peers/embree_scene.h"

namespace splatray::testing {

/// The mesh's triangles in `root`'s space, rounded to float32; primitive i is triangle i. To be handed to EmbreeScene::build.
[[nodiscard]] RTCGeometry triangle_geometry(RTCDevice device, const Mesh& mesh, const RootTransform& root);

}  // namespace splatray::testing
