/// Scenes without splats, for tests of views and lights.
#pragma once
#include "engine/scene/scene.h"

namespace splatray {

/// Bounding box [-1, 1]^3 around `center_world`, which is the root's centre; root edge `edge_world`.
inline Scene box_scene(const glm::dvec3& center_world = glm::dvec3(0.0), double edge_world = 2.5) {
  Scene scene;
  scene.root.origin_world = center_world - 0.5 * edge_world;
  scene.root.unit_world = edge_world / (1U << LATTICE_BITS);
  scene.bounds_min_world = center_world - 1.0;
  scene.bounds_max_world = center_world + 1.0;
  return scene;
}

}  // namespace splatray
