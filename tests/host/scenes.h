/// Scenes without a tree, for tests of views and lights.
#pragma once
#include <utility>
#include <vector>

#include "engine/scene/scene.h"
#include "engine/scene/splat.h"

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

/// Positions, world, and unit normals.
using OrientedPoints = std::vector<std::pair<glm::dvec3, glm::dvec3>>;

/// A scan of these points by one station at an unknown place, z up.
inline Scene scan_scene(const OrientedPoints& points) {
  glm::dvec3 low = points.front().first, high = low;
  for (const auto& [position, normal] : points) {
    low = glm::min(low, position);
    high = glm::max(high, position);
  }
  Scene scene;
  scene.up = {0.0, 0.0, 1.0};
  scene.stations.resize(1);
  scene.bounds_min_world = low;
  scene.bounds_max_world = high;
  const glm::dvec3 size = high - low;
  scene.root = {low - size, 4e-6 * std::max({size.x, size.y, size.z})};
  for (const auto& [position, normal] : points)
    scene.data_pool.edit().push_back(pack_splat({scene.root.to_root(position), normal, 4.0, 0}));
  return scene;
}

/// Points on the six sides of a box about the origin, as many on each, that face in.
inline OrientedPoints box_points(const glm::dvec3& size, bool roof) {
  OrientedPoints points;
  for (int a = 0; a <= 40; ++a)
    for (int b = 0; b <= 40; ++b) {
      const double u = a / 20.0 - 1.0, v = b / 20.0 - 1.0;
      for (int side = 0; side < (roof ? 6 : 5); ++side) {
        const int axis = side % 3;  // the last is the roof
        glm::dvec3 place(u), normal(0.0);
        place[(axis + 1) % 3] = v;
        place[axis] = side < 3 ? -1.0 : 1.0;
        normal[axis] = -place[axis];
        points.emplace_back(0.5 * place * size, normal);
      }
    }
  return points;
}

}  // namespace splatray
