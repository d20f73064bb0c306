/// Planes through the surroundings of points.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>

#include "preprocess/base/lanes.h"

namespace splatray {

/// Places of a point's neighbours relative to it, component by component.
struct Offsets {
  static constexpr std::size_t MOST = 32;

  std::size_t count = 0;
  float x[MOST], y[MOST], z[MOST];

  void add(const glm::vec3& offset) {
    x[count] = offset.x, y[count] = offset.y, z[count] = offset.z;
    ++count;
  }
};

/// The spread of places about their mean: a symmetric matrix.
struct Covariance {
  double xx, yy, zz, xy, xz, yz;
};

/// That of a point and the first `count` of its neighbours.
[[nodiscard]] Covariance covariance_of(const Offsets& offsets, std::size_t count);

/// Eigenvalues, ascending (Smith 1961, "Eigenvalues of a symmetric 3 x 3 matrix").
[[nodiscard]] glm::dvec3 variances_of(const Covariance& covariance);

/// The unit eigenvector of the least eigenvalue, given that; zero where no direction is the least: the two lesser eigenvalues
/// are the same.
[[nodiscard]] glm::dvec3 least_axis_of(const Covariance& covariance, const glm::dvec3& variances);

}  // namespace splatray
