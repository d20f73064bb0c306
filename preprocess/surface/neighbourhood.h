/// What surrounds a point.
#pragma once
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "preprocess/surface/cloud.h"
#include "preprocess/surface/neighbours.h"

namespace splatray {

/// Most neighbours of a neighbourhood.
inline constexpr std::size_t MOST_AROUND = 32;

/// A value of each neighbour, the nearest first.
using Around = std::array<double, MOST_AROUND>;

/// A vector of each neighbour, component by component, so that loops over neighbours vectorise.
struct VectorsAround {
  Around x, y, z;

  /// Scalar products with one vector.
  void dot(const glm::dvec3& v, std::size_t count, Around& products) const {
    for (std::size_t j = 0; j < count; ++j) products[j] = x[j] * v.x + y[j] * v.y + z[j] * v.z;
  }
};

/// A point's nearest sites, in cloud coordinates.
struct Neighbourhood {
  Neighbourhood(const Cloud& cloud, std::uint32_t point, std::span<const Neighbour> nearest)
      : normal(cloud.normal[point]), oriented(cloud.oriented), count(nearest.size()) {
    for (std::size_t j = 0; j < count; ++j) {
      const std::uint32_t other = nearest[j].index();
      const glm::vec3 to_other = cloud.coord[other] - cloud.coord[point];
      const glm::vec3& its_normal = cloud.normal[other];
      offset.x[j] = to_other.x, offset.y[j] = to_other.y, offset.z[j] = to_other.z;
      normals.x[j] = its_normal.x, normals.y[j] = its_normal.y, normals.z[j] = its_normal.z;
      distance_squared[j] = nearest[j].distance_squared();
    }
  }

  glm::dvec3 normal;  ///< of the point, as the cloud has it
  bool oriented;      ///< Cloud::oriented
  std::size_t count;  ///< entries of what follows
  VectorsAround offset;
  VectorsAround normals;
  Around distance_squared;
};

}  // namespace splatray
