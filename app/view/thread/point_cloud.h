/// A sample of points, as it is shown while the scene is made of all of them.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

namespace splatray {

struct PointCloud {
  glm::dvec3 origin_world{0.0};
  std::vector<glm::vec3> position;   ///< from the origin, world units
  std::vector<std::uint32_t> color;  ///< beside them, display-encoded, r in the lowest 8 bits
  std::vector<glm::vec3> normal;     ///< beside them, about right; zero = not known; empty = of none
  double spacing_world = 0.0;        ///< typical, between neighbours
};

/// Points that threads share.
using SharedPoints = std::shared_ptr<const PointCloud>;

}  // namespace splatray
