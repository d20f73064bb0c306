/// Planes through the surroundings of points, by running sums.
#pragma once
#include <array>
#include <glm/glm.hpp>

namespace splatray {

/// Eigenvalues of a symmetric matrix, ascending, and the unit eigenvector of the least.
struct LeastAxis {
  glm::dvec3 variance{0.0};
  glm::dvec3 axis{0.0};  ///< zero where no direction is the least: the two lesser eigenvalues are the same
};

/// Sums over weighted points of their offsets and products of offsets.
class PlaneFit {
 public:
  void add(const glm::dvec3& offset, double weight = 1.0) {
    const glm::dvec3 weighted = weight * offset;
    weight_ += weight;
    sum_ += weighted;
    xx_ += weighted.x * offset.x, xy_ += weighted.x * offset.y, xz_ += weighted.x * offset.z;
    yy_ += weighted.y * offset.y, yz_ += weighted.y * offset.z, zz_ += weighted.z * offset.z;
  }

  [[nodiscard]] double weight() const { return weight_; }
  [[nodiscard]] glm::dvec3 mean() const { return sum_ / weight_; }
  /// Variances of the points about their mean, ascending; weight() must be positive.
  [[nodiscard]] glm::dvec3 variances() const;
  /// The same, and the normal of the plane of least squares.
  [[nodiscard]] LeastAxis least_axis() const;

 private:
  /// xx, yy, zz, xy, xz, yz of the covariance.
  [[nodiscard]] std::array<double, 6> covariance() const;

  double weight_ = 0.0;
  glm::dvec3 sum_{0.0};
  double xx_ = 0.0, xy_ = 0.0, xz_ = 0.0, yy_ = 0.0, yz_ = 0.0, zz_ = 0.0;
};

}  // namespace splatray
