/// Affine transforms of meshes.
#pragma once
#include <glm/glm.hpp>

#include "preprocess/points.h"

namespace splatray {

/// Moves a mesh by `to_world`, in float64: positions; normals by the inverse transpose; radii by the cube
/// root of the volume's change. A mirroring transform reverses the winding, so that it keeps agreeing with
/// the outside.
void transform_mesh(Mesh& mesh, const glm::dmat4& to_world);

/// The image of an ellipse, whose disc has this radius and lies across `normal`, any length but 0, before the map; nothing of discs. An
/// ellipse's image is one again, with other axes where the map stretches unevenly: its half axes are the singular vectors of the images
/// of the two before, times the singular values (Golub and Van Loan 2013, "Matrix Computations", 8.6.3).
void transform_ellipse(const glm::dmat3& linear, const glm::vec3& normal, PointEllipse& ellipse,
                       float& radius);

}  // namespace splatray
