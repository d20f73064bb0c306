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
using NumbersAround = std::array<double, MOST_AROUND>;

/// A vector of each neighbour, component by component, so that loops over neighbours vectorise.
struct VectorsAround {
  NumbersAround x, y, z;

  /// Scalar products with one vector.
  void dot(const glm::dvec3& v, std::size_t count, NumbersAround& products) const {
    for (std::size_t j = 0; j < count; ++j) products[j] = x[j] * v.x + y[j] * v.y + z[j] * v.z;
  }
};

/// A point's nearest sites on its side of its clip lines, in cloud coordinates.
struct Neighbourhood {
  Neighbourhood(const Cloud& cloud, std::uint32_t point, std::span<const Neighbour> nearest)
      : normal(cloud.normal[point]),
        oriented(cloud.oriented),
        on_facets(cloud.on_facets),
        ends_known(cloud.ends_known || (!cloud.clip.empty() && cloud.clip[point].lines() > 0)),
        creases_known(ends_known && !cloud.ends_known),
        clip(cloud.clip.empty() ? PointClip{} : cloud.clip[point]),
        found(nearest.size()),
        seen_squared(nearest.empty() ? 0.0F : nearest.back().distance_squared()) {
    for (const Neighbour& neighbour : nearest) {
      const std::uint32_t other = neighbour.index();
      const glm::vec3 to_other = cloud.coord[other] - cloud.coord[point];
      if (clip.cuts(glm::dvec3(to_other))) continue;
      const glm::vec3& its_normal = cloud.normal[other];
      offset.x[count] = to_other.x, offset.y[count] = to_other.y, offset.z[count] = to_other.z;
      normals.x[count] = its_normal.x, normals.y[count] = its_normal.y, normals.z[count] = its_normal.z;
      distance_squared[count] = neighbour.distance_squared();
      ++count;
    }
  }

  glm::dvec3 normal;  ///< of the point, as the cloud has it
  bool oriented;      ///< Cloud::oriented
  bool on_facets;     ///< Cloud::on_facets
  bool ends_known;    ///< the surface ends, or has a crease, only where clip lines say so
  /// The point's clip lines were found among points, and neighbours suggest no others.
  bool creases_known;
  PointClip clip;         ///< of the point
  std::size_t found;      ///< sites looked at, also beyond the clip lines
  float seen_squared;     ///< squared distance of the farthest of them
  std::size_t count = 0;  ///< entries of what follows
  VectorsAround offset;
  VectorsAround normals;
  NumbersAround distance_squared;
};

}  // namespace splatray
