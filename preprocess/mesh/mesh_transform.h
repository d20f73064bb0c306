/// Affine transforms of meshes.
#pragma once
#include <glm/glm.hpp>

#include "preprocess/points.h"

namespace splatray {

/// Moves a mesh by `to_world`, in float64: positions; normals by the inverse transpose; radii by the cube
/// root of the volume's change. A mirroring transform reverses the winding, so that it keeps agreeing with
/// the outside.
void transform_mesh(Mesh& mesh, const glm::dmat4& to_world);

}  // namespace splatray
